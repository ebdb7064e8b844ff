// One step of a bitonic merge of blocks of 2^(stage-1) elements into blocks of 2^stage; stages from 11 on.
// modify  keys    uvec2 per element
// params  stage   log2 of the merged size
//         hop     log2 of the distance compared; stage - 1 is the mirrored first step
//         count   elements, a power of two
// define  BLOCK   1: this and all smaller distances (below 1024) at once, in shared memory
// threads: half the elements.
#include "order.glsl"

layout(local_size_x = 512) in;
layout(std430) buffer keys { uvec2 element[]; };
layout(std140) uniform Parameters {
  uint stage;
  uint hop;
  uint count;
};

#if BLOCK
shared uvec2 block[1024];

void main() {
  uint t = gl_LocalInvocationID.x, first = groupIndex() * 1024u;
  bool inside = first + 1024u <= count;
  block[t] = inside ? element[first + t] : kPadding;
  block[t + 512u] = inside ? element[first + t + 512u] : kPadding;
  barrier();
  for (uint stride = 512u; stride > 0u; stride >>= 1u) {
    uint low = (t & ~(stride - 1u)) * 2u + (t & (stride - 1u));
    uvec2 a = block[low], b = block[low + stride];
    if (comesAfter(a, b)) {
      block[low] = b;
      block[low + stride] = a;
    }
    barrier();
  }
  if (inside) {
    element[first + t] = block[t];
    element[first + t + 512u] = block[t + 512u];
  }
}
#else
void main() {
  uint t = groupIndex() * 512u + gl_LocalInvocationID.x;
  if (t >= count / 2u) return;
  uint stride = 1u << hop, offset = t & (stride - 1u);
  uint low = (t >> hop) * (stride * 2u) + offset;
  uint high = hop + 1u == stage ? low - offset + stride * 2u - 1u - offset : low + stride;
  uvec2 a = element[low], b = element[high];
  if (comesAfter(a, b)) {
    element[low] = b;
    element[high] = a;
  }
}
#endif
