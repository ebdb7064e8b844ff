// One step down the bloom pyramid: the separable filter [1 3 3 1] / 8, which keeps the mean. Scene-referred.
// read    source   the level above, `as linear`
// write   result   half its size: each texel stands for two by two, so that light stays where it is
uniform sampler2D source;
out vec4 result;

void main() {
  // A quarter of the way from the inner texel to the outer one.
  vec2 texel = 1.0 / vec2(textureSize(source, 0)), middle = 2.0 * gl_FragCoord.xy * texel;
  vec2 low = middle - 0.75 * texel, high = middle + 0.75 * texel;
  result = vec4(0.25 * (textureLod(source, low, 0.0).rgb + textureLod(source, vec2(high.x, low.y), 0.0).rgb +
                        textureLod(source, vec2(low.x, high.y), 0.0).rgb + textureLod(source, high, 0.0).rgb),
                1.0);
}
