// One layer of the half-size picture, blurred by its discs. Scene-referred; result premultiplied.
// read    source   from split; any sampler (texels are fetched)
//         tiles?   from reach: how far anything before the focus reaches here (layer before the focus only); without
//                  it every pixel is searched as far as a tile
// write   result   NEAR 1: what lies before the focus and how much of the pixel it covers, as each disc reaches and is spread thin
//                  NEAR 0: the mean of what is not before the focus within the pixel's own disc, of those whose discs reach;
//                  behind something nearer the mean of what can be seen beside it. Alpha: how far it can be trusted.
// params  rings    of samples around the middle one, 8, 16, 24 ... in each; small discs take fewer
//         blades   of the aperture; fewer than 3 make it round
//         tile     pixels along a tile's side
// defines NEAR
#include "coc.glsl"

uniform sampler2D source;
#ifdef HAS_TILES
uniform sampler2D tiles;
#endif
layout(std140) uniform Parameters {
  int rings;
  int blades;
  int tile;
};
out vec4 result;

const float kTau = 6.28318530717959;

float outline(float angle) {
  if (blades < 3) return 1.0;
  float sector = kTau / float(blades);
  return cos(sector * 0.5) / cos(mod(angle, sector) - sector * 0.5);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(source, 0) - 1;
  vec4 own = texelFetch(source, pixel, 0);
#if NEAR
#ifdef HAS_TILES
  float radius = texelFetch(tiles, pixel / tile, 0).r;
#else
  float radius = float(tile);
#endif
  if (radius <= 0.0) {
    result = vec4(0.0);
    return;
  }
#else
  float radius = abs(own.a);
  bool hidden = own.a < 0.0;
  float trust = hidden ? 1.0 : max(blurOf(2.0 * own.a), 4e-3);
  if (!hidden && radius <= 0.25) {
    result = vec4(own.rgb * trust, trust);
    return;
  }
#endif
  float span = radius + 0.5;
  int n = clamp(int(ceil(span)), 1, rings);
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  vec3 sum = vec3(0.0);
  float weights = 0.0, area = 0.0;
  for (int ring = 0; ring <= n; ++ring) {
    int count = max(8 * ring, 1);
    float across = span * float(ring) / (float(n) + 0.5);
    float step_angle = kTau / float(count), angle = step_angle * noise;
    vec2 direction = vec2(cos(angle), sin(angle)), turn = vec2(cos(step_angle), sin(step_angle));
    for (int i = 0; i < count; ++i) {
      float shape = outline(angle);
      ivec2 at = clamp(ivec2(floor(gl_FragCoord.xy + across * shape * direction)), ivec2(0), last);
      angle += step_angle;
      direction = vec2(direction.x * turn.x - direction.y * turn.y, direction.x * turn.y + direction.y * turn.x);
      vec4 c = texelFetch(source, at, 0);
      float reach = clamp(abs(c.a) - across + 0.5, 0.0, 1.0) * span * span / (c.a * c.a + 1.0 / 12.0);
#if NEAR
      float w = c.a > 0.0 ? blurOf(2.0 * c.a) * reach : 0.0;
#else
      float w = c.a < 0.0 ? 0.0 : hidden ? 1.0 : blurOf(2.0 * c.a) * reach;
#endif
      w *= shape * shape;
      area += shape * shape;
      sum += w * c.rgb;
      weights += w;
    }
  }
#if NEAR
  float cover = min(weights / area, 1.0);
  result = weights > 0.0 ? vec4(sum / weights * cover, cover) : vec4(0.0);
#else
  result = vec4((weights > 0.0 ? sum / weights : own.rgb) * trust, trust);
#endif
}
