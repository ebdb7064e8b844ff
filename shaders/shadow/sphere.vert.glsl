// Spheres into a shadow map, as triangles: see shadow/from_spot.glsl.
#include "scene/instances.glsl"
#include "shadow/from_spot.glsl"

in vec3 position;

void main() {
  Instance self = instance[gl_InstanceID];
  gl_Position = lightClip(self.center + self.radius * position);
}
