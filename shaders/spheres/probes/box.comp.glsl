// The bounding box of all spheres, which the probes fill. One group of 256 threads.
// read    instances   the spheres
// write   box         vec4 low, vec4 high; zeros when there are no spheres
// params  count       spheres
#include "scene/instances.glsl"

layout(local_size_x = 256) in;
layout(std430) writeonly buffer box { vec4 box_low, box_high; };
layout(std140) uniform Parameters { uint count; };

shared vec3 lows[256];
shared vec3 highs[256];

void main() {
  uint self = gl_LocalInvocationIndex;
  vec3 low = vec3(3.4e38), high = vec3(-3.4e38);
  for (uint i = self; i < count; i += 256u) {
    low = min(low, instance[i].center - instance[i].radius);
    high = max(high, instance[i].center + instance[i].radius);
  }
  lows[self] = low;
  highs[self] = high;
  barrier();
  for (uint hop = 128u; hop > 0u; hop /= 2u) {
    if (self < hop) {
      lows[self] = min(lows[self], lows[self + hop]);
      highs[self] = max(highs[self], highs[self + hop]);
    }
    barrier();
  }
  if (self != 0u) return;
  box_low = count > 0u ? vec4(lows[0], 0.0) : vec4(0.0);
  box_high = count > 0u ? vec4(highs[0], 0.0) : vec4(0.0);
}
