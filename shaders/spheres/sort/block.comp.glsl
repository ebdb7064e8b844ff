// Keys of all instances, back to front by power, and each block of 2 * 2^HALF sorted in shared memory: the first HALF + 1 stages of the
// bitonic sort.
// read    instances  draw list
// write   keys       uvec2 per element, pow2ceil(count) of them; the rest is padded with the greatest key
// params  count      instances
// define  HALF   0 to 9, default 9; less for fewer elements than 1024, which then cost less
// threads: half the elements. Merges of larger blocks follow in spheres/sort/merge.comp.glsl.
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

void main() {
  uint t = gl_LocalInvocationID.x, first = groupIndex() * 2u * kHalf;
  // In a loop, software reads a uniform separately for each lane, but not an expression computed before it.
  vec3 from = eye;
  uint many = max(count, 1u);
  for (uint i = t; i < 2u * kHalf; i += kHalf) {
    uint index = first + i;
    vec4 s = index < many ? vec4(instance[index].center, instance[index].radius) : vec4(0.0);
    precise vec3 to = s.xyz - from;
    precise float power = ((to.x * to.x + to.y * to.y) + to.z * to.z) - s.w * s.w;
    block[i] = uvec2(index < many ? depthKey(power) : kPadding.x, index);
  }
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
  for (uint i = t; i < 2u * kHalf && first + i < size; i += kHalf) element[first + i] = block[i];
}
