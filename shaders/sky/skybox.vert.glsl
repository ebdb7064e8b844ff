// The environment as background. Directions are linear over the picture, and levels constant, so both are computed here.
#include "common/view.glsl"
#include "maps.glsl"
#include "ibl/roughness_level.glsl"

noperspective out vec3 direction;  // world, not normalized
noperspective out vec2 uv;
#ifdef HAS_VELOCITY
noperspective out vec3 before;     // the direction in last frame's clip space: x, y, w
#endif
// Lookups, see common/equirect.glsl; the level is 0 as long as the map is magnified.
flat out vec2 sky_lookup;
flat out vec3 sky_smooth;    // the texels of the level in x and y, and the share of the spline
#ifdef HAS_BLURRED
flat out vec2 blurred_lookup;
flat out vec3 blurred_smooth;
flat out float blurred_share;
#ifdef HAS_BRIGHTEST
flat out vec3 spots_blur;  // alpha; what light times spotDistribution is to be multiplied by; variance of the disc
#endif
#endif
#ifdef HAS_DISC
flat out vec3 sun;         // towards it
flat out vec2 disc_edge;   // the disc is as much as disc_edge.x - disc_edge.y * tan(angle to its middle) is above 0, up to 1
flat out vec3 disc_radiance;
#endif

vec2 lookupOf(sampler2D map, float least) {
  vec2 size = vec2(textureSize(map, 0));
  return equirectLookup(max(equirectLevel(size.x, lookupAngle()), least), 0.5 / size.y);
}

vec3 smoothOf(sampler2D map, float level) {
  vec2 size = vec2(textureSize(map, int(ceil(level))));
#ifdef HAS_DISC  // the computed sky: a constant, since software drivers run both sides of a branch
  return vec3(size, 0.0);
#else
  return vec3(size, texelFetch(map, ivec2(0), 0).a * splineShare(size.y, pixelAngle()));
#endif
}

void main() {
  uv = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
  gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);
  direction = viewRay(uv);
#ifdef HAS_VELOCITY
  before = (previous_view_projection * vec4(direction, 0.0)).xyw;
#endif
  sky_lookup = lookupOf(sky, 0.0);
  sky_smooth = smoothOf(sky, sky_lookup.x);
  float roughness = 0.25 * blur;
#ifdef HAS_BLURRED
  float in_map = alphaOfRoughness(max(roughness, kSharpest));
  blurred_lookup = lookupOf(blurred, levelOfAlpha(in_map, textureQueryLevels(blurred)));
  blurred_smooth = smoothOf(blurred, blurred_lookup.x);
  blurred_share = min(roughness / kSharpest, 1.0);
#endif
#ifdef HAS_DISC
  sun = turnedAbout(disc_at.xyz, sky_turn);
  // From this least size on, the sum over pixels is within 1 % the same wherever the middle is in its pixel.
  float pixel = pixelAngle() * max(dot(sun, -transpose(mat3(view))[2]), 0.01), seen = max(disc_at.w, 1.1 * pixel), edge = 1.8 * pixel;
  disc_edge = vec2(seen / edge + 0.5, 1.0 / edge);
  // Up to a blur as wide as the disc, a mix with the spot.
  float alpha = alphaOfRoughness(roughness), spot_share = clamp(2.0 * alpha / seen - 0.5, 0.0, 1.0);
  disc_radiance = disc_light.rgb * ((1.0 - spot_share) / (kPi * (seen * seen + edge * edge / 20.0)));
  float variance = 0.25 * seen * seen;
#elif defined HAS_BLURRED && defined HAS_BRIGHTEST
  float spot_share = blurred_share, alpha = in_map, variance = 0.0;
#endif
#if defined HAS_BLURRED && defined HAS_BRIGHTEST
  alpha = clamp(alpha, 1e-3, 0.995);
  float a2 = alpha * alpha;
  // Lobes of the map are those of V = N, weighted by N.L: over their mean N.L, with cos^2 of the half vector's angle as in ibl/brdf.comp.
  float s = 1.0 + a2, mean = a2 / ((1.0 - a2) * (1.0 - a2)) * (s / a2 - 2.0 - 2.0 * log(0.5 * s / a2));
  spots_blur = vec3(alpha, spot_share * 0.25 / (kPi * mean), variance);
#endif
}
