// Keys of all instances, and each block of 1024 sorted in shared memory: the first ten stages of the bitonic sort.
// read    instances  draw list
// write   keys       uvec2 per element, pow2ceil(count) of them; the rest is padded with the greatest key
// params  count      instances
// threads: half the elements. Merges of larger blocks follow in sort/merge.comp.glsl.
#include "common/view.glsl"
#include "scene/instances.glsl"
#include "order.glsl"

layout(local_size_x = 512) in;
layout(std430) writeonly buffer keys { uvec2 element[]; };
layout(std140) uniform Parameters { uint count; };

shared uvec2 block[1024];

uvec2 elementOf(uint index) {
  if (index >= count) return uvec2(kPadding.x, index);
  vec3 c = instance[index].center;
  precise float depth = -(((view[0].z * c.x + view[1].z * c.y) + view[2].z * c.z) + view[3].z);
  return uvec2(depthKey(depth), index);
}

void compareAndSwap(uint low, uint high) {
  uvec2 a = block[low], b = block[high];
  if (comesAfter(a, b)) {
    block[low] = b;
    block[high] = a;
  }
}

void main() {
  uint t = gl_LocalInvocationID.x, first = groupIndex() * 1024u;
  block[t] = elementOf(first + t);
  block[t + 512u] = elementOf(first + t + 512u);
  barrier();
  for (uint k = 1u; k <= 10u; ++k) {
    uint half_size = 1u << (k - 1u);
    // Mirrored first step: both halves are ascending, so every merge is.
    uint base = (t >> (k - 1u)) << k, offset = t & (half_size - 1u);
    compareAndSwap(base + offset, base + (half_size << 1u) - 1u - offset);
    barrier();
    for (uint stride = half_size >> 1u; stride > 0u; stride >>= 1u) {
      uint low = (t & ~(stride - 1u)) * 2u + (t & (stride - 1u));
      compareAndSwap(low, low + stride);
      barrier();
    }
  }
  uint size = uint(element.length());
  if (first + t < size) element[first + t] = block[t];
  if (first + t + 512u < size) element[first + t + 512u] = block[t + 512u];
}
