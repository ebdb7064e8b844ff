// Radiance filtered by the GGX lobe around each direction, for the split sum (N = V = R), equirectangular.
// read    environment  equirectangular with mips, `as linear wrap`
// write   result       one level, rgba16f; each work group is 64 texels of one row
// params  level, levels   which level of how many: roughness as in roughness_level.glsl
//         samples         per texel, at most 256
//         spread          levels of the environment beyond a sample's share of the sphere: from 0.25 on neighbors overlap, and a small light
//                         does not show the pattern of the samples; below it the lobe is sharper
//
// Samples of the normal distribution, each read at the level whose texels match the sample's share of the sphere
// (Krivanek and Colbert, EGSR 2008) and weighted by N.L. There are more of them in the tail, each with less of the light: few
// of equal weight would show there as stars. All texels of a row have the same samples but for a
// rotation: their map coordinates relative to the texel are computed once per work group.
#include "common/equirect.glsl"
#include "common/slice.glsl"
#include "roughness_level.glsl"

layout(local_size_x = 64) in;
uniform sampler2D environment;
layout(rgba16f) uniform writeonly image2D result;
layout(std140) uniform Parameters {
  int level;
  int levels;
  int samples;
  float spread;
};

const int kMaxSamples = 256;
shared vec4 table[kMaxSamples];  // u offset, v, level of the environment, weight

const float kGolden = 0.61803399;  // of a turn from sample to sample: any number of them is spread evenly

void fillTable(float theta, int count) {
  float alpha = alphaOfRoughness(roughnessOfLevel(float(level), levels)), a2 = alpha * alpha;
  vec2 base = vec2(textureSize(environment, 0));
  float texel = 2.0 * kPi / base.x * kPi / base.y;  // solid angle at the equator
  float cos_n = cos(theta), sin_n = sin(theta);
  for (int i = int(gl_LocalInvocationID.x); i < count; i += 64) {
    float t = 1.0 - (float(i) + 0.5) / float(count), u = 1.0 - t * t, heavy = 2.0 * t;
    float phi = 2.0 * kPi * fract(kGolden * float(i));
    float cos2_h = (1.0 - u) / (1.0 + (a2 - 1.0) * u);
    float cos_l = 2.0 * cos2_h - 1.0;              // N.L of V = N reflected about the sampled normal
    float sin_l = sqrt(max(1.0 - cos_l * cos_l, 0.0));
    float d = cos2_h * (a2 - 1.0) + 1.0;
    float pdf = a2 / (kPi * d * d) * 0.25;         // D (N.H) / (4 V.H), and V = N
    // N is in the XY plane at longitude 0; the frame's other axes are the map's down and longitude.
    vec3 local = vec3(sin_l * cos(phi), sin_l * sin(phi), cos_l);
    vec3 direction = vec3(sin_n * local.z + cos_n * local.x, cos_n * local.z - sin_n * local.x, local.y);
    vec2 at = equirectUv(direction);
    float share = heavy / (float(count) * pdf);
    float lod = 0.5 * log2(share / (texel * max(length(direction.xz), 0.05))) + spread;
    lod = clamp(lod, 0.0, float(textureQueryLevels(environment) - 1));
    float half_texel = 0.5 * exp2(ceil(lod)) / base.y;
    at.y = clamp(at.y, min(half_texel, 0.5), max(1.0 - half_texel, 0.5));
    table[i] = vec4(at.x - 0.5, at.y, lod, heavy * max(cos_l, 0.0));
  }
}

void main() {
  ivec2 size = imageSize(result);
  ivec2 at = ivec2(sliceInvocation().x, sliceGroup().y);
  vec2 center = (vec2(at) + 0.5) / vec2(size);
  int count = clamp(samples, 1, kMaxSamples);
  fillTable(center.y * kPi, count);
  barrier();
  if (at.x >= size.x || at.y >= size.y) return;
  vec4 sum = vec4(0.0);
  for (int i = 0; i < count; ++i) {
    vec4 one = table[i];
    sum += one.w * vec4(textureLod(environment, vec2(center.x + one.x, one.y), one.z).rgb, 1.0);
  }
  imageStore(result, at, vec4(sum.rgb / sum.a, 1.0));
}
