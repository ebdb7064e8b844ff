// Spheres from far to near.
// read  order  @draw_order
#include "common/view.glsl"
#include "scene/instances.glsl"

layout(std430) readonly buffer order { uvec2 order_element[]; };

in vec3 position;
flat out vec3 albedo;

void main() {
  Instance self = instance[order_element[gl_InstanceID].y];
  albedo = self.albedo;
  gl_Position = view_projection * vec4(self.center + self.radius * position, 1.0);
}
