// The part of the ground that a sphere darkens: an octagon around the point below it.
// read    ground   see scene/ground.glsl
// params  extent   reach of a sphere, in radii
#include "common/view.glsl"
#include "scene/ground.glsl"
#include "scene/instances.glsl"

layout(std140) uniform Parameters { float extent; };

out vec3 to_center;           // from the ground, in radii
flat out vec2 window;         // how it ends with the distance, see contact.frag.glsl
flat out vec3 albedo;
flat out vec3 shared_albedo;  // times the ground's own
flat out int cut;             // 1: the ground's own horizon cuts the sphere; 0: all of it is above that

const float kOctagon = 0.41421356;  // tan(pi / 8)

void main() {
  Instance self = instance[gl_InstanceID];
  float height = ground_row[0].height, above = self.center.y - height, far = extent * self.radius;
  // Vertices in pairs from left to right, the lower one first.
  int pair = gl_VertexID >> 1;
  float upper = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
  vec2 side = pair == 0 || pair == 3 ? vec2(1.0, upper * kOctagon) : vec2(kOctagon, upper);
  if (pair < 2) side.x = -side.x;
  vec2 offset = side * sqrt(max(far * far - above * above, 0.0));
  to_center = vec3(-offset.x, above, -offset.y) / self.radius;
  window = vec2(1.0 / (0.25 * extent), -3.0);  // 0 at three quarters of the extent, 1 at its end
  albedo = self.albedo;
  shared_albedo = self.albedo * groundAlbedo(ground_row[0]);
  cut = above < self.radius * 0.9999 ? 1 : 0;
  bool visible = abs(above) < far && (cut == 0 || abs(above) < self.radius * 0.9999);
  vec3 at = vec3(self.center.x + offset.x, height, self.center.z + offset.y);
  vec4 clip = view_projection * vec4(at, 1.0);
  gl_Position = visible ? clip : vec4(2.0, 2.0, 2.0, 1.0);
}
