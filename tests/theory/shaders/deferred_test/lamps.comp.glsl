// Two lamps that cast shadows: one all round, one a spot that looks straight down, the latter the first with spot_first.
// write   lamps      see scene/lamps.glsl
// params  first, second   where they are
//         candela         of each
//         far             range of each
//         outer           half angle of the spot, degrees
layout(local_size_x = 2) in;
#include "lamp_rows.glsl"
layout(std140) uniform Parameters {
  vec3 first;
  vec3 second;
  float candela;
  float far;
  float outer;
  bool spot_first;
};

void main() {
  bool spot = (gl_GlobalInvocationID.x == 1u) != spot_first;
  Lamp one;
  one.position = spot ? second : first;
  one.range = far;
  one.intensity = vec3(candela);
  one.direction = vec3(0.0, -1.0, 0.0);
  one.cos_outer = spot ? cos(radians(outer)) : -1.0;
  one.cos_inner = spot ? cos(radians(0.8 * outer)) : -1.0;
  one.near_plane = 0.05;
  one.shadow = int(gl_GlobalInvocationID.x);
  lamp[gl_GlobalInvocationID.x] = one;
}
