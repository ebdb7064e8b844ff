// One step down the bloom pyramid: the separable filter [1 3 3 1] / 8, which keeps the mean. Scene-referred.
// read    source   the level above; any sampler (texels are fetched)
// write   result   half its size
uniform sampler2D source;
out vec4 result;

void main() {
  ivec2 last = textureSize(source, 0) - 1;
  ivec2 base = ivec2(gl_FragCoord.xy) * 2 - 1;
  const float weight[4] = float[4](0.125, 0.375, 0.375, 0.125);
  vec3 sum = vec3(0.0);
  for (int y = 0; y < 4; ++y) {
    vec3 row = vec3(0.0);
    int row_y = clamp(base.y + y, 0, last.y);
    for (int x = 0; x < 4; ++x) row += weight[x] * texelFetch(source, ivec2(clamp(base.x + x, 0, last.x), row_y), 0).rgb;
    sum += weight[y] * row;
  }
  result = vec4(sum, 1.0);
}
