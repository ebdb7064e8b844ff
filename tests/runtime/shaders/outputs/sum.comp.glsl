// Counts frames. One group.
// read    before  the last frame's `result`
// write   result  vec4: frames so far, twice as many, amount, 0
//         counts  four whole numbers from frames so far on
// params  amount
layout(local_size_x = 1) in;
layout(std430) readonly buffer before { vec4 old; };
layout(std430) writeonly buffer result { vec4 sum; };
layout(std430) writeonly buffer counts { uint numbers[4]; };
layout(std140) uniform Parameters { float amount; };

void main() {
  float n = old.x + 1.0;
  sum = vec4(n, 2.0 * n, amount, 0.0);
  for (uint i = 0u; i < 4u; ++i) numbers[i] = uint(n) + i;
}
