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
  for (uint half_width = 128u; half_width > 0u; half_width /= 2u) {
    barrier();
    if (lane < half_width) part[lane] += part[lane + half_width];
  }
  if (lane == 0u) mean = vec4(part[0]);
}
