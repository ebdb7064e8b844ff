// The environment as background. Directions are linear over the picture, and levels constant, so both are computed here.
// Texels that are wide in the picture are smooth, and need fewer pixels than it has (near the poles they are narrow, and get softer):
// defines WIDE   draws these for `enlarged` of skybox.frag.glsl: a "quad" in a target of half the picture's size, at least 4 x 4
//         FINE   draws all others
// params  rows   with WIDE, of the picture; see skybox.frag.glsl for the others
#ifndef WIDE
#define WIDE 0
#endif
#ifndef FINE
#define FINE 0
#endif
#include "common/view.glsl"
#include "maps.glsl"
#include "ibl/roughness_level.glsl"

noperspective out vec3 direction;  // world, not normalized
noperspective out vec2 uv;
#ifdef HAS_VELOCITY
noperspective out vec3 before;     // the direction in last frame's clip space: x, y, w
#endif
#ifdef HAS_ENLARGED
noperspective out vec2 enlarged_uv;
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

// Radians that a pixel of the picture covers.
#if WIDE
float pictureAngle() { return 2.0 / (projection[1].y * rows); }
#else
float pictureAngle() { return pixelAngle(); }
#endif

vec2 lookupOf(sampler2D map, float least) {
  vec2 size = vec2(textureSize(map, 0));
  return equirectLookup(max(equirectLevel(size.x, lookupShare() * pictureAngle()), least), 0.5 / size.y);
}

vec3 smoothOf(sampler2D map, float level) {
  vec2 size = vec2(textureSize(map, int(ceil(level))));
#ifdef HAS_DISC  // the computed sky: a constant, since software drivers run both sides of a branch
  return vec3(size, 0.0);
#else
  return vec3(size, texelFetch(map, ivec2(0), 0).a * splineShare(size.y, pictureAngle()));
#endif
}

// Pixels of the picture across a texel, by smoothOf(); 0: it is not to be smoothed.
float smoothWidth(vec3 of) { return of.z > 0.0 ? texelWidth(of.y, pictureAngle()) : 0.0; }

void main() {
  sky_lookup = lookupOf(sky, 0.0);
  sky_smooth = smoothOf(sky, sky_lookup.x);
  float roughness = 0.25 * blur;
#ifdef HAS_BLURRED
  float in_map = alphaOfRoughness(max(roughness, kSharpest));
  blurred_lookup = lookupOf(blurred, levelOfAlpha(in_map, textureQueryLevels(blurred)));
  blurred_smooth = smoothOf(blurred, blurred_lookup.x);
  blurred_share = min(roughness / kSharpest, 1.0);
#endif
#if WIDE || FINE || defined HAS_ENLARGED
  float width = smoothWidth(sky_smooth);
#ifdef HAS_BLURRED
  width = min(blurred_share < 1.0 ? width : 1e30, smoothWidth(blurred_smooth));
#endif
  // The three programs may round differently, so FINE and WIDE, which `enlarged` covers or reads, draw a little longer.
  bool drawn = FINE == 1 ? width < 3.501 : width >= (WIDE == 1 ? 3.499 : 3.5);
#else
  const bool drawn = true;
#endif
#if WIDE || defined HAS_ENLARGED
  // `side`: the part of the small target that is drawn, less a pixel on each side for linear lookups. Its pixels are two of the picture's
  // wide where all of it is drawn. Texels get two of its pixels, if it has them, and wider ones, which show their shape, more.
#if WIDE
  vec2 small = viewport;
#else
  vec2 small = vec2(textureSize(enlarged, 0));
#endif
  vec2 rim = 1.0 / small, side = clamp(4.0 / max(width, 1.0), 0.7, 1.0) * (1.0 - 2.0 * rim);
#endif
#if WIDE
  vec2 at = vec2(gl_VertexID & 1, gl_VertexID >> 1) * (side + 2.0 * rim);
  uv = (at - rim) / side;
#else
  vec2 at = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
  uv = at;
#endif
#ifdef HAS_ENLARGED
  enlarged_uv = rim + uv * side;
#endif
  gl_Position = drawn ? vec4(at * 2.0 - 1.0, 0.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
  direction = viewRay(uv);
#ifdef HAS_VELOCITY
  before = (previous_view_projection * vec4(direction, 0.0)).xyw;
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
#ifdef HAS_DISC
  spot_share *= smoothstep(-seen, seen, sun.y);
#endif
  spots_blur = vec3(alpha, spot_share * 0.25 / (kPi * mean), variance);
#endif
}
