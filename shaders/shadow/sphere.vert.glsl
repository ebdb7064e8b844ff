// Spheres into a shadow map, as triangles: see shadow/from_spot.glsl.
#include "scene/instances.glsl"
#include "shadow/from_spot.glsl"

in vec3 position;
#ifdef HAS_THING_IN_FRONT
flat out uint thing;
#endif

void main() {
#ifdef HAS_THING_IN_FRONT
  thing = ~uint(gl_InstanceID);
#endif
  Instance self = instance[gl_InstanceID];
  gl_Position = lightClip(self.center + self.radius * position);
}
