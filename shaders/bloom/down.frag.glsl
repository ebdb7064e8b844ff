// One step down the bloom pyramid: the separable filter [1 3 3 1] / 8, which keeps the mean. Scene-referred. Of an odd number of texels
// each result has a little more than two, so that light stays where it is.
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
  ivec2 size = textureSize(source, 0);
  vec2 step_size = vec2(size) / vec2(max(size / 2, ivec2(1)));  // texels of the source; 2 where they are even
#if LINEAR
  // A quarter of the way from the inner texel to the outer one.
  vec2 texel = 1.0 / vec2(size), middle = gl_FragCoord.xy * step_size * texel;
  vec2 low = middle - 0.75 * texel, high = middle + 0.75 * texel;
  sum = 0.25 * (textureLod(source, low, 0.0).rgb + textureLod(source, vec2(high.x, low.y), 0.0).rgb +
                textureLod(source, vec2(low.x, high.y), 0.0).rgb + textureLod(source, high, 0.0).rgb);
#else
  ivec2 last = size - 1;
  vec2 low = gl_FragCoord.xy * step_size - 1.25, high = low + 1.5, f = 0.5 * fract(low), g = 0.5 * fract(high);
  ivec2 a = ivec2(floor(low)), b = ivec2(floor(high));
  ivec2 at[4] = ivec2[4](a, a + 1, b, b + 1);
  vec2 weight[4] = vec2[4](0.5 - f, f, 0.5 - g, g);
  for (int y = 0; y < 4; ++y) {
    vec3 row = vec3(0.0);
    int row_y = clamp(at[y].y, 0, last.y);
    for (int x = 0; x < 4; ++x) row += weight[x].x * texelFetch(source, ivec2(clamp(at[x].x, 0, last.x), row_y), 0).rgb;
    sum += weight[y].y * row;
  }
#endif
  result = vec4(sum, 1.0);
}
