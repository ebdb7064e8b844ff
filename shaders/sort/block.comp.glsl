// Keys of all instances, and each block of 2 * 2^HALF sorted in shared memory: the first HALF + 1 stages of the bitonic sort.
// read    instances  draw list
// write   keys       uvec2 per element, pow2ceil(count) of them; the rest is padded with the greatest key
// params  count      instances
// define  HALF   0 to 9, default 9; less for fewer elements than 1024, which then cost less
// threads: half the elements. Merges of larger blocks follow in sort/merge.comp.glsl.
#include "common/view.glsl"
#include "scene/instances.glsl"
#include "order.glsl"

#ifndef HALF
#define HALF 9
#endif
const uint kHalf = 1u << HALF;

layout(local_size_x = 1 << HALF) in;
layout(std430) writeonly buffer keys { uvec2 element[]; };
layout(std140) uniform Parameters { uint count; };

shared uvec2 block[2u * kHalf];

uvec2 elementOf(uint index) {
  if (index >= count) return uvec2(kPadding.x, index);
  vec3 c = instance[index].center;
  precise float depth = -(((view[0].z * c.x + view[1].z * c.y) + view[2].z * c.z) + view[3].z);
  return uvec2(depthKey(depth), index);
}

void main() {
  uint t = gl_LocalInvocationID.x, first = groupIndex() * 2u * kHalf;
  block[t] = elementOf(first + t);
  block[t + kHalf] = elementOf(first + t + kHalf);
  barrier();
  for (uint k = 1u; k <= uint(HALF + 1); ++k) {
    uint half_size = 1u << (k - 1u);
    for (uint stride = half_size; stride > 0u; stride >>= 1u) {
      // The first step is mirrored: both halves are ascending, so every merge is.
      uint low = (t & ~(stride - 1u)) * 2u + (t & (stride - 1u)), high = low ^ (stride == half_size ? 2u * stride - 1u : stride);
      uvec2 a = block[low], b = block[high];
      if (comesAfter(a, b)) {
        block[low] = b;
        block[high] = a;
      }
      barrier();
    }
  }
  uint size = uint(element.length());
  if (first + t < size) element[first + t] = block[t];
  if (first + t + kHalf < size) element[first + t + kHalf] = block[t + kHalf];
}
