// The environment without its brightest spot, at the size of the result: what the specular map is made of.
// read    environment  equirectangular with mips, `as linear wrap`
//         brightest?   see brightest.glsl; without it all of the environment
// write   result       level 0, rgba16f
#include "common/equirect_direction.glsl"
#include "common/slice.glsl"
#include "brightest.glsl"

layout(local_size_x = 64) in;
uniform sampler2D environment;
layout(rgba16f) uniform writeonly image2D result;

float most(vec3 color) { return max(color.r, max(color.g, color.b)); }

vec3 environmentAt(vec2 map_uv, float level) {
  return sampleEquirect(environment, map_uv, equirectLookup(level, 0.5 / float(textureSize(environment, 0).y))).rgb;
}

void main() {
  ivec2 size = imageSize(result), at = ivec2(sliceInvocation().x, sliceGroup().y);
  if (at.x >= size.x || at.y >= size.y) return;
  vec2 center = (vec2(at) + 0.5) / vec2(size);
  float base_width = float(textureSize(environment, 0).x);
  vec3 radiance;
  if (distance(equirectDirection(center), brightest_at.xyz) > kWindow + 4.0 / float(size.y)) {
    radiance = environmentAt(center, max(log2(base_width / float(size.x)), 0.0));
  } else {
    // Four points of a level in which the spot is not yet spread.
    radiance = vec3(0.0);
    float level = max(ceil(log2(base_width / 2048.0)), 0.0);
    for (int i = 0; i < 4; ++i) {
      vec3 color = environmentAt(center + (vec2(i & 1, i >> 1) - 0.5) * 0.5 / vec2(size), level);
      radiance += 0.25 * color * min(brightest_at.w / max(most(color), 1e-9), 1.0);
    }
  }
  imageStore(result, at, vec4(radiance, 1.0));
}
