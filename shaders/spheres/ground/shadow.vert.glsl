// The rectangle around the shadow of a sphere on the ground, with its penumbra, of each light: as triangles.
// read    ground   see scene/ground.glsl
//         sun or brightest, params: see spheres/ground/shadow.glsl
#include "common/view.glsl"
#include "scene/ground.glsl"
#include "scene/instances.glsl"
#include "spheres/ground/shadow.glsl"

out vec3 at;  // world
flat out vec4 sphere;
flat out vec4 light;
flat out int spot;

const float kLowest = 0.02;  // sine of the elevation below which shadows do not get longer

void main() {
  Instance self = instance[gl_InstanceID];
  spot = gl_VertexID / 6;
  light = lightAndAngle(spot);
  sphere = vec4(self.center, self.radius);
  float height = ground_row[0].height, above = self.center.y - height, rise = max(light.y, kLowest);
  vec2 horizontal = light.xz, along = dot(horizontal, horizontal) > 1e-8 ? normalize(horizontal) : vec2(1.0, 0.0);
  int corner = gl_VertexID % 6;
  corner = corner < 3 ? corner : corner < 5 ? 5 - corner : 3;  // 0 1 2, 2 1 3
  vec2 side = vec2(corner & 1, corner >> 1) * 2.0 - 1.0;
  float across = self.radius + tan(min(light.w, 1.2)) * (max(above, 0.0) + self.radius) / rise;
  vec2 center = self.center.xz - horizontal * (above / rise);
  vec2 place = center + along * (side.x * across / rise) + vec2(-along.y, along.x) * (side.y * across);
  at = vec3(place.x, height, place.y);
  bool visible = light.y > 0.0 && above > -self.radius;
  vec4 clip = view_projection * vec4(at, 1.0);
  gl_Position = visible ? clip : vec4(2.0, 2.0, 2.0, 1.0);
}
