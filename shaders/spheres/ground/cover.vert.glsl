// The part of the picture that a ray-traced sphere certainly hides: an octagon inside its outline, two pixels smaller. The ground behind it
// need not be shaded.
#include "common/view.glsl"
#include "scene/instances.glsl"

const float kMargin = 2.0;                          // pixels
const vec2 kCorner = vec2(0.92387953, 0.38268343);  // cosine and sine of pi / 8

void main() {
  Instance self = instance[gl_InstanceID];
  bool perspective = projection[3].w == 0.0;
  vec3 apart = eye - self.center, backwards = transpose(mat3(view))[2], away = perspective ? apart : backwards;
  float far = length(away), ratio = perspective ? min(self.radius / max(far, 1e-30), 1.0) : 0.0;
  vec3 towards = away / max(far, 1e-30), middle = self.center + towards * (self.radius * ratio);
  float angle = pixelAngle(), depth = max(-(view * vec4(self.center, 1.0)).z, 0.0), pixel = perspective ? angle * depth : angle;
  float rim = self.radius * sqrt(1.0 - ratio * ratio) - kMargin * pixel;
  // Vertices in pairs from left to right, the lower one first.
  int pair = gl_VertexID >> 1;
  vec2 corner = pair == 0 || pair == 3 ? kCorner : kCorner.yx;
  if (pair < 2) corner.x = -corner.x;
  if ((gl_VertexID & 1) == 0) corner.y = -corner.y;
  vec3 across = normalize(cross(abs(towards.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), towards));
  vec3 at = middle + (across * corner.x + cross(towards, across) * corner.y) * rim;
  vec4 clip = view_projection * vec4(at, 1.0);
  gl_Position = rim > 0.0 && ratio < 0.999 ? clip : vec4(2.0, 2.0, 2.0, 1.0);
}
