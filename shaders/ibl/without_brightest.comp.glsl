// The environment without its brightest spots, at the size of the result: the source of the specular map.
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
  vec2 center = (vec2(at) + 0.5) / vec2(size);
  float base_width = float(textureSize(environment, 0).x);
  bool near = false;
  for (int i = 0; i < spot_count; ++i)
    near = near || distance(equirectDirection(center), spots[i].at.xyz) <= kWindow + 4.0 / float(size.y);
  // Near a spot, four points of a level in which it is not yet blurred. One lookup in a loop serves both cases: in software, all texels
  // take every lookup of a condition, but only their own of a loop.
  float level = max(near ? ceil(log2(base_width / 2048.0)) : log2(base_width / float(size.x)), 0.0);
  int points = near ? 4 : 1;
  float most_kept = max(spots[0].at.w, 0.0);  // read before the loop: in it software reads it for each lane by itself
  vec3 radiance = vec3(0.0);
  for (int i = 0; i < points; ++i) {
    vec2 offset = near ? (vec2(i & 1, i >> 1) - 0.5) * 0.5 / vec2(size) : vec2(0.0);
    vec3 color = environmentAt(center + offset, level);
    radiance += color * (near ? 0.25 * min(most_kept / max(most(color), 1e-9), 1.0) : 1.0);
  }
  imageStore(result, at, vec4(radiance, 1.0));  // outside of the map nothing is stored
}
