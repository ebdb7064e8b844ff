// The blurred far field in place of the sharp picture, at full size, also below the near field. Scene-referred.
// Drawn at a depth (far_field.vert.glsl, far_beside_near.vert.glsl), so that other pixels cost only a depth test and stay exactly as they
// are.
// read    source   radiance, nearest: own texel of what `result` modifies, with "feedback"
//         blurred  from fill, `as linear`
// modify  result   radiance; alpha stays
//         tested   the picture's depth, with "depth_test": "greater", or "less" beside the near field, and "depth_write": false
#include "common/finite.glsl"

uniform sampler2D source, blurred;
noperspective in vec2 at, at_half;  // uv of the full picture and of the fields
out vec4 result;

void main() {
  vec4 own = textureLod(source, at, 0.0), layer = textureLod(blurred, at_half, 0.0);
  result = vec4(layer.a > 0.0 ? layer.rgb / max(layer.a, 1e-4) : finite(own.rgb), own.a);
}
