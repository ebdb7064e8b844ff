// Spheres of the draw list.
#include "common/view.glsl"
#include "scene/instances.glsl"

in vec3 position;
flat out vec3 albedo;

void main() {
  Instance self = instance[gl_InstanceID];
  albedo = self.albedo;
  gl_Position = view_projection * vec4(self.center + self.radius * position, 1.0);
}
