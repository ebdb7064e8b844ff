// A sphere of the draw list.
#include "common/view.glsl"
#include "scene/instances.glsl"

in vec3 position;
in vec3 normal;
out vec3 world, facing;
flat out vec3 color;

void main() {
  Instance self = instance[gl_InstanceID];
  world = self.center + self.radius * position;
  facing = normal;
  color = self.albedo;
  gl_Position = view_projection * vec4(world, 1.0);
}
