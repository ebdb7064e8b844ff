// Vertices, and the arguments of commands, as a frame of particles would leave them.
// write   spots      x, y in texels, size of a point, value
// write   commands   three records of a draw, of which two are taken and one draws
// write   groups     work groups
layout(local_size_x = 1) in;
layout(std430) writeonly buffer spots { vec4 spot[]; };
layout(std430) writeonly buffer commands { uint command[]; };
layout(std430) writeonly buffer groups { uint group[]; };

void main() {
  const vec4 all[18] = vec4[18](
      vec4(2.5, 2.5, 1, 2), vec4(8, 8, 4, 3), vec4(4.5, 8.5, 3, 4),                        // points
      vec4(0.5, 5.5, 1, 5), vec4(2.5, 5.5, 1, 6),                                         // drawn indirectly
      vec4(1.2, 12.5, 1, 7), vec4(6.2, 12.5, 1, 7), vec4(1.2, 10.5, 1, 7), vec4(6.2, 10.5, 1, 7),  // lines
      vec4(9.2, 12.5, 1, 8), vec4(14.2, 12.5, 1, 8), vec4(14.2, 15.2, 1, 8),              // a strip of lines
      vec4(0, 14, 1, 9), vec4(2, 14, 1, 9), vec4(0, 16, 1, 9), vec4(2, 14, 1, 9), vec4(2, 16, 1, 9), vec4(0, 16, 1, 9));
  for (int i = 0; i < 18; ++i) spot[i] = all[i];
  const uint records[12] = uint[12](2u, 1u, 3u, 0u, 1u, 0u, 0u, 0u, 1u, 1u, 0u, 0u);
  for (int i = 0; i < 12; ++i) command[i] = records[i];
  group[0] = 3u;
  group[1] = 2u;
  group[2] = 1u;
}
