// Spheres into a shadow map, as triangles.
#include "common/view.glsl"
#include "scene/instances.glsl"

in vec3 position;

void main() {
  Instance self = instance[gl_InstanceID];
  gl_Position = view_projection * vec4(self.center + self.radius * position, 1.0);
}
