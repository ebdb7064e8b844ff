// Whole numbers x - 10 y, stored as an image.
// write  result  r32i
layout(local_size_x = 4, local_size_y = 4) in;
layout(r32i) uniform writeonly iimage2D result;

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(at, imageSize(result)))) imageStore(result, at, ivec4(at.x - 10 * at.y));
}
