// One step down the bloom pyramid: the separable filter [1 3 3 1] / 8, which keeps the mean. Scene-referred.
// read    source   the level above; any sampler (texels are fetched), for LINEAR `as linear`
// write   result   half its size
// defines LINEAR   default 0; 1: four lookups instead of sixteen, half the cost
#ifndef LINEAR
#define LINEAR 0
#endif
uniform sampler2D source;
out vec4 result;

void main() {
  vec3 sum = vec3(0.0);
#if LINEAR
  // A quarter of the way from the inner texel to the outer one.
  vec2 texel = 1.0 / vec2(textureSize(source, 0)), middle = gl_FragCoord.xy * 2.0 * texel;
  vec2 low = middle - 0.75 * texel, high = middle + 0.75 * texel;
  sum = 0.25 * (textureLod(source, low, 0.0).rgb + textureLod(source, vec2(high.x, low.y), 0.0).rgb +
                textureLod(source, vec2(low.x, high.y), 0.0).rgb + textureLod(source, high, 0.0).rgb);
#else
  ivec2 last = textureSize(source, 0) - 1;
  ivec2 base = ivec2(gl_FragCoord.xy) * 2 - 1;
  const float weight[4] = float[4](0.125, 0.375, 0.375, 0.125);
  for (int y = 0; y < 4; ++y) {
    vec3 row = vec3(0.0);
    int row_y = clamp(base.y + y, 0, last.y);
    for (int x = 0; x < 4; ++x) row += weight[x] * texelFetch(source, ivec2(clamp(base.x + x, 0, last.x), row_y), 0).rgb;
    sum += weight[y] * row;
  }
#endif
  result = vec4(sum, 1.0);
}
