// One face of a lamp's shadow map: the floor and the spheres, as formulas.
// read    instances   @spheres
//         lamps
// write   depth       near_plane / distance along the axis of the face, 0 where there is nothing
// params  count, floor_y
//         which       lamp
//         side        0..5: +X -X +Y -Y +Z -Z
#include "scene/instances.glsl"
#include "scene/lamps.glsl"

layout(std140) uniform Parameters {
  int count;
  float floor_y;
  int which;
  int side;
};
in vec2 uv;

void main() {
  // OpenGL 4.5, table 8.19.
  vec2 st = uv * 2.0 - 1.0;
  vec3 d = side == 0   ? vec3(1.0, -st.y, -st.x)
           : side == 1 ? vec3(-1.0, -st.y, st.x)
           : side == 2 ? vec3(st.x, 1.0, st.y)
           : side == 3 ? vec3(st.x, -1.0, -st.y)
           : side == 4 ? vec3(st.x, -st.y, 1.0)
                       : vec3(-st.x, -st.y, -1.0);
  vec3 from = lamp[which].position;
  float nearest = 1e30, to_floor = (floor_y - from.y) / d.y;
  if (to_floor > 0.0) nearest = to_floor;
  for (int i = 0; i < count; ++i) {
    vec3 to = instance[i].center - from;
    float dd = dot(d, d), along = dot(to, d), root2 = along * along - dd * (dot(to, to) - instance[i].radius * instance[i].radius);
    if (root2 > 0.0 && along > 0.0) nearest = min(nearest, (along - sqrt(root2)) / dd);
  }
  gl_FragDepth = nearest < 1e30 ? lamp[which].near_plane / nearest : 0.0;
}
