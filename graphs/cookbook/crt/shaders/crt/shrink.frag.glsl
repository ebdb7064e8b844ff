// The middle of the picture on fewer pixels: each is the mean of what it covers, in linear light.
// read    source   encoded picture
// write   result   linear, 0..1
#include "linear.glsl"

uniform sampler2D source;
in vec2 uv;
out vec4 result;

void main() {
  vec2 all = vec2(textureSize(source, 0)), target = 1.0 / vec2(dFdx(uv.x), dFdy(uv.y));
  float scale = min(all.x / target.x, all.y / target.y);
  vec2 low = 0.5 * (all - scale * target) + scale * floor(gl_FragCoord.xy), high = low + scale;
  vec4 sum = vec4(0.0);
  for (int y = int(low.y); y < int(ceil(high.y)); ++y)
    for (int x = int(low.x); x < int(ceil(high.x)); ++x) {
      vec2 covered = min(vec2(x, y) + 1.0, high) - max(vec2(x, y), low);
      vec3 color = texelFetch(source, min(ivec2(x, y), textureSize(source, 0) - 1), 0).rgb;
      sum += covered.x * covered.y * vec4(decodeSrgb(color), 1.0);
    }
  result = vec4(sum.rgb / sum.w, 1.0);
}
