// One of the boxes of a list.
// read    list   numbers of boxes
#include "common/view.glsl"
#include "town.glsl"

in vec3 position;
in vec3 normal;
layout(std430) readonly buffer list { uint box[]; };
layout(std140) uniform Parameters { int blocks; };
out vec3 world;
flat out vec3 facing, color;

void main() {
  Box self = boxOf(box[gl_InstanceID], blocks);
  world = self.center + self.half_size * position;
  facing = normal;
  color = self.color;
  gl_Position = view_projection * vec4(world, 1.0);
}
