// The part of the ground from which a sphere takes light of the sky: a square around the point below it.
// read    ground   see scene/ground.glsl
// params  extent   in radii: how far away a sphere hides anything
#include "common/view.glsl"
#include "scene/ground.glsl"
#include "scene/instances.glsl"

layout(std140) uniform Parameters { float extent; };

out vec3 at;  // world
flat out vec4 sphere;
flat out vec4 albedo_reach;

void main() {
  Instance self = instance[gl_InstanceID];
  float height = ground_row[0].height, above = self.center.y - height, far = extent * self.radius;
  vec2 side = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  at = vec3(self.center.x, height, self.center.z) + vec3(side.x, 0.0, side.y) * sqrt(max(far * far - above * above, 0.0));
  sphere = vec4(self.center, self.radius);
  albedo_reach = vec4(self.albedo, extent);
  bool visible = abs(above) < far && above > -self.radius;
  gl_Position = visible ? view_projection * vec4(at, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
