// The shadow map of deferred_test/sun: the floor, the spheres, and the half of a plane above the floor that has x < 0, as formulas.
// read    instances   @spheres
//         sun
// write   depth
// params  count, floor_y
//         roof        height of the half plane
#include "scene/instances.glsl"
#include "scene/sun.glsl"

layout(std140) uniform Parameters {
  int count;
  float floor_y;
  float roof;
};
in vec2 uv;

void main() {
  mat4 m = sun_light[0].shadow_matrix;
  vec3 d = sun_light[0].direction;
  vec3 start = 256.0 * ((uv.x - 0.5) * vec3(m[0].x, m[1].x, m[2].x) + (uv.y - 0.5) * vec3(m[0].y, m[1].y, m[2].y));
  float highest = (floor_y - start.y) / d.y;
  float to_roof = (roof - start.y) / d.y;
  if (start.x + to_roof * d.x < 0.0) highest = max(highest, to_roof);
  for (int i = 0; i < count; ++i) {
    vec3 to = instance[i].center - start;
    float along = dot(to, d), root2 = instance[i].radius * instance[i].radius - dot(to, to) + along * along;
    if (root2 > 0.0) highest = max(highest, along + sqrt(root2));
  }
  gl_FragDepth = 0.5 + highest / 32.0;
}
