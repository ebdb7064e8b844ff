// Cosine-weighted mean radiance around each direction (irradiance / pi), equirectangular.
// read   environment  equirectangular with mips, `as linear wrap`
//        brightest?   see brightest.glsl
// define ABOVE  1: of the half above the horizon alone; what is below counts as black
// write  result       rgba16f; COLUMNS wide: every row is one work group. a: the mean cosine of the first spot's light on the coarse grid:
//                     times the spot's irradiance / pi it is its part of rgb
//        cosines?     rgba16f, as large: yzw of the other spots; x: 0
//
// Direct integration over a grid of COLUMNS x COLUMNS / 2 cells of the environment, taken at the level where a texel is as large as a cell,
// with the exact solid angle of each cell and normalized by the sum of the weights: a constant environment is kept exactly, and the
// variation of the cosine inside a cell costs less than 0.1 %. (Nine spherical harmonics would ring by several percent beside a sun.) Cells
// rotate with the column of the result, so the weights of a row are computed once.
#include "common/equirect.glsl"
#include "common/slice.glsl"
#include "brightest.glsl"

#ifndef ABOVE
#define ABOVE 0
#endif
const int kRows = COLUMNS / 2, kLit = ABOVE == 1 ? kRows / 2 : kRows;  // rows of cells; those that count, from the top
layout(local_size_x = COLUMNS) in;
uniform sampler2D environment;
layout(rgba16f) uniform writeonly image2D result;
#ifdef HAS_COSINES
layout(rgba16f) uniform writeonly image2D cosines;
#endif

shared float weights[kRows * COLUMNS];

void main() {
  ivec2 size = imageSize(result);
  int row = int(sliceGroup().y);
  float theta = (float(row) + 0.5) / float(size.y) * kPi;
  float cos_n = cos(theta), sin_n = sin(theta);
  int column = int(gl_LocalInvocationID.x);
  float cos_phi = cos(float(column) * (2.0 * kPi / float(COLUMNS)));
  int rows = size.y > 0 ? kRows : 1;  // not a constant: unrolled, the loop takes longer to translate
  for (int y = 0; y < rows; ++y) {
    // A cell is cos(top) - cos(bottom) high: the sine of its middle times a constant, which normalizing takes out.
    float middle = (float(y) + 0.5) * (kPi / float(kRows)), cos_m = cos(middle), sin_m = sqrt(1.0 - cos_m * cos_m);
    weights[y * COLUMNS + column] = max(cos_n * cos_m + sin_n * sin_m * cos_phi, 0.0) * sin_m;
  }
  barrier();

  int x = int(sliceInvocation().x);
  if (x >= size.x || row >= size.y) return;
#if EXACT
  int level = int(log2(float(textureSize(environment, 0).x) / float(COLUMNS)) + 0.5);
#else
  float level = max(log2(float(textureSize(environment, 0).x) / float(COLUMNS)), 0.0);
#endif
  float u = (float(x) + 0.5) / float(size.x);
  vec4 sum = vec4(0.0);
  for (int y = 0; y < kRows; ++y) {
    float v = (float(y) + 0.5) / float(kRows);
    // To both sides, up to the first cell below the horizon; the nearest and the farthest column are the same on both.
    for (int k = 0; k <= COLUMNS / 2; ++k) {
      float weight = weights[y * COLUMNS + k] * (k == 0 || k == COLUMNS / 2 ? 0.5 : 1.0);
      if (weight <= 0.0) break;
#if EXACT
      vec3 radiance = texelFetch(environment, ivec2((x + k) & (COLUMNS - 1), y), level).rgb;
      radiance += texelFetch(environment, ivec2((x - k) & (COLUMNS - 1), y), level).rgb;
#else
      vec3 radiance = textureLod(environment, vec2(u + float(k) / float(COLUMNS), v), level).rgb;
      radiance += textureLod(environment, vec2(u - float(k) / float(COLUMNS), v), level).rgb;
#endif
      sum += weight * vec4(y < kLit ? radiance : vec3(0.0), 2.0);
    }
  }
  vec4 of_spots = vec4(0.0);
  for (int i = 0; i < spot_count; ++i) {
    // The cells that the spot covers have its light: a rectangle as wide as the spot is on average.
    vec4 spot_at = spots[i].at;
    vec2 cells = vec2(COLUMNS, kRows), at = equirectUv(spot_at.xyz) * cells;
    float wide = sqrt(3.0 * spots[i].light.w), from_pole = sqrt(max(1.0 - spot_at.y * spot_at.y, 1e-4));
    vec2 reach = clamp(vec2(wide / from_pole * 0.5, wide) * cells / kPi, 1e-3, 0.5 * float(COLUMNS));
    vec2 first = at - reach, last = at + reach;
    float spot = 0.0;
    for (int r = max(int(floor(first.y)), 0); r <= min(int(floor(last.y)), kLit - 1); ++r) {
      float of_row = min(last.y, float(r + 1)) - max(first.y, float(r)), part = 0.0;
      for (int c = int(floor(first.x)); c <= int(floor(last.x)); ++c)
        part += (min(last.x, float(c + 1)) - max(first.x, float(c))) * weights[r * COLUMNS + (c - x + 2 * COLUMNS) % COLUMNS];
      spot += part * of_row / sin((float(r) + 0.5) * (kPi / float(kRows)));
    }
    // At a pole a part of the rectangle is outside of the map.
    of_spots[i] = spot / (2.0 * reach.x * (min(last.y, float(kRows)) - max(first.y, 0.0)));
  }
  imageStore(result, ivec2(x, row), vec4(sum.rgb / sum.a, of_spots.x));
#ifdef HAS_COSINES
  imageStore(cosines, ivec2(x, row), vec4(0.0, of_spots.yzw));
#endif
}
