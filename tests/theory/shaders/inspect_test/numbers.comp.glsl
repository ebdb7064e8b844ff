// write   ids      x + 10 y, and the largest integer at (7, 3)
//         table    squares, as floats
layout(local_size_x = 8, local_size_y = 4) in;
layout(r32ui) writeonly uniform uimage2D ids;
layout(std430) buffer table { float squares[16]; };

void main() {
  uvec2 at = gl_GlobalInvocationID.xy;
  imageStore(ids, ivec2(at), uvec4(at == uvec2(7, 3) ? 0xffffffffu : at.x + 10u * at.y));
  uint i = gl_LocalInvocationIndex;
  if (i < 16u) squares[i] = float(i * i);
}
