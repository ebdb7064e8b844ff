// Mean luminance (Rec. 709) of each row of an equirectangular map, times the row's share of the sphere's solid angle.
// read   environment  level 0
// write  rows         a float per row; each row is one work group. Their sum is the mean over the sphere
//
// Row y lies between the heights cos(y pi / h) and cos((y + 1) pi / h): its zone is half their difference (Archimedes).
#include "common/slice.glsl"

layout(local_size_x = 64) in;
uniform sampler2D environment;
layout(std430) writeonly buffer rows { float row_mean[]; };

const float kPi = 3.14159265358979;
shared float part[64];

void main() {
  ivec2 size = textureSize(environment, 0);
  int y = int(sliceGroup().y);
  uint lane = gl_LocalInvocationID.x;
  float sum = 0.0;
  for (int x = int(lane); x < size.x; x += 64)
    sum += dot(texelFetch(environment, ivec2(x, y), 0).rgb, vec3(0.2126, 0.7152, 0.0722));
  part[lane] = sum;
  barrier();
  if (lane != 0u || y >= size.y) return;
  for (uint other = 1u; other < 64u; ++other) sum += part[other];
  float zone = 0.5 * (cos(float(y) / float(size.y) * kPi) - cos(float(y + 1) / float(size.y) * kPi));
  row_mean[y] = sum / float(size.x) * zone;
}
