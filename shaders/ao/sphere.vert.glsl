// An octagon around the outline of a sphere, a pixel wider. Perspective views only; a sphere is not drawn when the eye is in it or nearly
// touches it.
#include "common/view.glsl"
#include "scene/instances.glsl"

flat out vec4 sphere;  // center in view space, radius

const vec2 kCorner = vec2(1.0, 0.41421356);  // of an octagon around the unit circle: tan(pi / 8)

void main() {
  Instance self = instance[gl_InstanceID];
  vec3 c = (view * vec4(self.center, 1.0)).xyz;
  float far = length(c), ratio = self.radius / max(far, 1e-30);
  sphere = vec4(c, self.radius);
  vec3 towards = -c / max(far, 1e-30), middle = c + towards * (self.radius * ratio);
  float rim = self.radius * sqrt(max(1.0 - ratio * ratio, 0.0)) + pixelAngle() * max(-c.z, 0.0);
  // Vertices in pairs from left to right, the lower one first.
  int pair = gl_VertexID >> 1;
  vec2 corner = pair == 0 || pair == 3 ? kCorner : kCorner.yx;
  if (pair < 2) corner.x = -corner.x;
  if ((gl_VertexID & 1) == 0) corner.y = -corner.y;
  vec3 across = normalize(cross(abs(towards.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), towards));
  vec4 clip = projection * vec4(middle + (across * corner.x + cross(towards, across) * corner.y) * rim, 1.0);
  gl_Position = self.radius > 0.0 && ratio < 0.999 ? clip : vec4(2.0, 2.0, 2.0, 1.0);
}
