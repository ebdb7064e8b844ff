// The sum of the rows of luminance_rows: the mean luminance over the sphere.
// read    rows       `count` floats
// write   luminance  vec4: the mean luminance in all its components
// params  count
layout(local_size_x = 256) in;
layout(std430) readonly buffer rows { float row_mean[]; };
layout(std430) writeonly buffer luminance { vec4 mean; };
layout(std140) uniform Parameters { int count; };

shared float part[256];

void main() {
  uint lane = gl_LocalInvocationID.x;
  float sum = 0.0;
  for (int y = int(lane); y < count; y += 256) sum += row_mean[y];
  part[lane] = sum;
  barrier();
  if (lane != 0u) return;
  for (uint other = 1u; other < 256u; ++other) sum += part[other];
  mean = vec4(sum);
}
