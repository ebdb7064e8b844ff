// One row of dots on what is there, and a level of ones.
// modify  dots
// write   level
layout(local_size_x = 16) in;
layout(rgba16f) uniform image2D dots;
layout(rgba16f) uniform writeonly image2D level;

void main() {
  int x = int(gl_GlobalInvocationID.x);
  imageStore(dots, ivec2(x, x), imageLoad(dots, ivec2(x, x)) + 0.5);
  for (int y = 0; y < 16; ++y) imageStore(level, ivec2(x, y), vec4(1.0));
}
