// The environment behind everything. Directions are linear over the picture, and levels constant, so both are computed here.
#include "common/view.glsl"
#include "maps.glsl"

noperspective out vec3 direction;  // world, not normalised
noperspective out vec2 uv;
#ifdef HAS_VELOCITY
noperspective out vec3 before;     // the direction in last frame's clip space: x, y, w
#endif
// Lookups, see common/equirect.glsl; the level is 0 as long as the map is magnified.
flat out vec2 sky_lookup;
#ifdef HAS_BLURRED
flat out vec2 blurred_lookup;
#endif

vec2 lookupOf(sampler2D map, float least) {
  vec2 size = vec2(textureSize(map, 0));
  return equirectLookup(max(equirectLevel(size.x, pixelAngle()), least), size.y);
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
  blurred_lookup = lookupOf(blurred, max(blur, 1.0));
#endif
}
