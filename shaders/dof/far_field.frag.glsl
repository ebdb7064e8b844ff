// Blends the blurred far field over the sharp picture, at full size, also below the near field. Scene-referred.
// Drawn at a depth (far_field.vert.glsl), so that pixels in focus cost only a depth test and stay exactly as they are.
// read    source   radiance, nearest: own texel of what `result` modifies, with "feedback"
//         depth    reversed-Z, nearest
//         blurred  from fill, `as linear`
// modify  result   radiance; alpha stays
//         tested   the same depth, with "depth_test": "greater", or "less" for NEAR, and "depth_write": false
// params  infinity, focus   as in split
//         tile     texels of the fields along a tile's side, for NEAR
// defines NEAR, default 0; 1: beside the near field, in the tiles of far_beside_near.vert.glsl
#ifndef NEAR
#define NEAR 0
#endif
#include "common/finite.glsl"
#include "coc.glsl"
#include "far_field.glsl"

uniform sampler2D source, depth, blurred;
noperspective in vec2 at, at_half;  // uv of the full picture and of the fields
flat in vec2 lens;                  // radius at depth 0, and how much it falls to depth 1
out vec4 result;

void main() {
  vec4 own = textureLod(source, at, 0.0);
  float radius = lens.x - lens.y * textureLod(depth, at, 0.0).r;
#if NEAR
  // Small discs of the near field are blended over the sharp picture: their surface continues into the focus.
  float blur = nearShown(radius);
#else
  float blur = step(kSmall, radius);
#endif
  vec4 layer = textureLod(blurred, at_half, 0.0);
  blur = layer.a > 0.0 ? blur : 0.0;
  result = vec4(blur > 0.0 ? mix(finite(own.rgb), layer.rgb / max(layer.a, 1e-4), blur) : own.rgb, own.a);
}
