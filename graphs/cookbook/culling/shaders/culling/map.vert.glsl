// All boxes from above.
// read    state   of each box
#include "town.glsl"

in vec3 position;
layout(std430) readonly buffer state { uint box_state[]; };
layout(std140) uniform Parameters { int blocks; };
flat out vec4 color;

void main() {
  Box self = boxOf(gl_InstanceID, blocks);
  vec3 at = self.center + self.half_size * position;
  color = vec4[](vec4(0.1, 0.1, 0.14, 0.6), vec4(0.6, 0.12, 0.1, 1.0), vec4(1.0, 0.95, 0.7, 1.0))[box_state[gl_InstanceID]];
  gl_Position = vec4(vec2(at.x, -at.z) / (3.0 * float(blocks)), 0.5, 1.0);
}
