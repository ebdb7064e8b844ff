// Each texel knows its place: x, y, amount, 1; NaN at (1, 1), infinite at (2, 1).
// write   result   any floating format
// params  amount   the blue channel
layout(std140) uniform Parameters { float amount; };
out vec4 result;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  result = vec4(vec2(at), amount, 1.0);
  if (at == ivec2(1, 1)) result.r = uintBitsToFloat(0x7fc00000u);
  if (at == ivec2(2, 1)) result.g = uintBitsToFloat(0x7f800000u);
}
