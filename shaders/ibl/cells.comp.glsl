// Mean radiance of the cells of the irradiance sum, weighted by solid angle: the levels of a loaded map are plain means, which are wrong
// near a pole, where a sun would count up to 16 times, or half.
// read    environment  equirectangular with mips
// write   result       rgba16f, a texel per cell
// Each cell is the mean of the texels in it, in a level with 16 to 31 of them from side to side at most; beside a pole, of all texels.
#include "common/slice.glsl"

layout(local_size_x = 64) in;
uniform sampler2D environment;
layout(rgba16f) uniform writeonly image2D result;

const float kPi = 3.14159265358979;

void main() {
  ivec2 size = imageSize(result), at = ivec2(sliceInvocation().x, sliceGroup().y), whole = textureSize(environment, 0);
  float texels = float(whole.x) / float(size.x);
  int level = at.y == 0 || at.y == size.y - 1 ? 0 : int(max(log2(texels / 16.0), 0.0));
  vec2 map = vec2(max(whole >> level, ivec2(1))), first = vec2(at) * map / vec2(size), last = vec2(at + 1) * map / vec2(size);
  vec4 sum = vec4(0.0);
  for (float y = floor(first.y); y < last.y - 1e-3; ++y) {
    float from = max(first.y, y), to = min(last.y, y + 1.0);
    vec4 row = vec4(0.0);
    for (float x = floor(first.x); x < last.x - 1e-3; ++x)
      row += (min(last.x, x + 1.0) - max(first.x, x)) * vec4(texelFetch(environment, ivec2(x, y), level).rgb, 1.0);
    sum += (to - from) * sin(0.5 * (from + to) * kPi / map.y) * row;
  }
  imageStore(result, at, vec4(sum.rgb / sum.a, 1.0));  // outside of the map nothing is stored
}
