// Lamps spread at random over a box, one after the other all round, a spot that looks down, all round.
// write   lamps   see scene/lamps.glsl
// params  count
//         extent  half the size of the box about (0, 1.5, 0)
//         reach   range of each, times 0.5 to 1.5
layout(local_size_x = 64) in;
#include "lamp_rows.glsl"
layout(std140) uniform Parameters {
  int count;
  float reach;
  vec3 extent;
};

// Jarzynski and Olano, JCGT 2020.
uvec3 pcg3d(uvec3 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
  v ^= v >> 16u;
  v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
  return v;
}
vec3 random(uint i, uint what) { return vec3(pcg3d(uvec3(i, what, 7u))) * (1.0 / 4294967296.0); }

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(count)) return;
  vec3 b = random(i, 1u);
  Lamp one;
  one.position = vec3(0.0, 1.5, 0.0) + (random(i, 0u) * 2.0 - 1.0) * extent;
  one.range = reach * (0.5 + b.x);
  one.intensity = 0.1 + 2.0 * random(i, 2u);
  bool spot = i % 3u == 1u;
  one.direction = normalize(vec3(b.y - 0.5, -0.7, b.z - 0.5));
  one.cos_outer = spot ? mix(0.2, 0.95, random(i, 3u).x) : -1.0;
  one.cos_inner = spot ? mix(one.cos_outer, 1.0, 0.5) : -1.0;
  one.near_plane = 0.05;
  one.shadow = -1;
  lamp[i] = one;
}
