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
#ifdef HAS_BLURRED
flat out vec2 blurred_lookup;
flat out float blurred_share;
#ifdef HAS_BRIGHTEST
flat out vec3 spot;
flat out vec4 spot_shape;  // the members of a SpotShape, which would take four vectors
flat out vec3 spot_light;  // times spotDistribution and the cosine: radiance
#endif
#endif

vec2 lookupOf(sampler2D map, float least) {
  vec2 size = vec2(textureSize(map, 0));
  return equirectLookup(max(equirectLevel(size.x, lookupAngle()), least), 0.5 / size.y);
}

void main() {
  uv = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
  gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);
  direction = viewRay(uv);
#ifdef HAS_VELOCITY
  before = (previous_view_projection * vec4(direction, 0.0)).xyw;
#endif
  sky_lookup = lookupOf(sky, 0.0);
#ifdef HAS_BLURRED
  float roughness = max(0.25 * blur, kSharpest);
  blurred_lookup = lookupOf(blurred, levelOfAlpha(alphaOfRoughness(roughness), textureQueryLevels(blurred)));
  blurred_share = min(0.25 * blur / kSharpest, 1.0);
#ifdef HAS_BRIGHTEST
  spot = towardsBrightest(sky_turn);
  float alpha = min(alphaOfRoughness(roughness), 0.995), a2 = alpha * alpha;
  SpotShape shape = spotShape(alpha, 0.25 * brightest_light.w);
  spot_shape = vec4(shape.alpha2, shape.tail, shape.bump, shape.per_core);
  // Lobes of the map are those of V = N, weighted by N.L: over their mean N.L, with cos^2 of the half vector's angle as in ibl/brdf.comp.
  float s = 1.0 + a2, mean = a2 / ((1.0 - a2) * (1.0 - a2)) * (s / a2 - 2.0 - 2.0 * log(0.5 * s / a2));
  spot_light = brightest_light.rgb * (0.25 / (kPi * mean));
#endif
#endif
}
