// A step of the bitonic sort: each thread puts two keys in order that are `hop` apart.
// modify  keys    uvec2[]: ascending by x in the end
layout(local_size_x = 64) in;

layout(std430) buffer keys { uvec2 key[]; };
layout(std140) uniform Parameters { uint stage; uint hop; };

void main() {
  uint t = gl_GlobalInvocationID.x;
  if (2u * t >= uint(key.length())) return;
  uint a = t / hop * 2u * hop + t % hop, b = a + hop;
  bool ascending = (a & stage) == 0u;
  uvec2 x = key[a], y = key[b];
  if ((x.x > y.x) == ascending) {
    key[a] = y;
    key[b] = x;
  }
}
