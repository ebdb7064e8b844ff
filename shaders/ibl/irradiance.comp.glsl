// Cosine-weighted mean radiance around each direction (irradiance / pi), equirectangular.
// read   environment  equirectangular with mips, `as linear wrap`
// write  result       rgba16f; COLUMNS wide: every row is one work group
//
// Direct integration over a grid of COLUMNS x COLUMNS / 2 cells of the environment, taken at the level where a texel is as large as a cell, with
// the exact solid angle of each cell and normalised by the sum of the weights: a constant environment is kept exactly, and
// the cosine's variation inside a cell costs less than 0.1 %. (Nine spherical harmonics would ring by several per cent
// beside a sun.) Cells turn with the column of the result, so the weights of a row are computed once.
#include "common/equirect.glsl"
#include "common/slice.glsl"

const int kRows = COLUMNS / 2;
layout(local_size_x = COLUMNS) in;
uniform sampler2D environment;
layout(rgba16f) uniform writeonly image2D result;

shared float weights[kRows * COLUMNS];

void main() {
  ivec2 size = imageSize(result);
  int row = int(sliceGroup().y);
  float theta = (float(row) + 0.5) / float(size.y) * kPi;
  float cos_n = cos(theta), sin_n = sin(theta);
  int column = int(gl_LocalInvocationID.x);
  float cos_phi = cos(float(column) * (2.0 * kPi / float(COLUMNS)));
  for (int y = 0; y < kRows; ++y) {
    float top = cos(float(y) * (kPi / float(kRows))), bottom = cos(float(y + 1) * (kPi / float(kRows)));
    float middle = (float(y) + 0.5) * (kPi / float(kRows));
    weights[y * COLUMNS + column] = max(cos_n * cos(middle) + sin_n * sin(middle) * cos_phi, 0.0) * (top - bottom);
  }
  barrier();

  int x = int(sliceInvocation().x);
  if (x >= size.x || row >= size.y) return;
  float level = max(log2(float(textureSize(environment, 0).x) / float(COLUMNS)), 0.0);
  float u = (float(x) + 0.5) / float(size.x);
  vec4 sum = vec4(0.0);
  for (int y = 0; y < kRows; ++y) {
    float v = (float(y) + 0.5) / float(kRows);
    for (int k = 0; k < COLUMNS; ++k) {
      float weight = weights[y * COLUMNS + k];
      vec3 radiance = textureLod(environment, vec2(u + float(k) / float(COLUMNS), v), level).rgb;
      sum += weight * vec4(radiance, 1.0);
    }
  }
  imageStore(result, ivec2(x, row), vec4(sum.rgb / sum.a, 1.0));
}
