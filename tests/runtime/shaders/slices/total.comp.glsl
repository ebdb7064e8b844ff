// The sum of a map, by one invocation.
#include "common/slice.glsl"

layout(local_size_x = 1) in;
uniform sampler2D mapped;
layout(std430) buffer total { vec4 sum; };

void main() {
  if (sliceInvocation().x > 0) return;
  ivec2 size = textureSize(mapped, 0);
  float s = 0.0;
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) s += texelFetch(mapped, ivec2(x, y), 0).x;
  sum = vec4(s / float(size.x * size.y));
}
