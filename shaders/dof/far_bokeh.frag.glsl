// The far field at half size, spread over its discs but for what fill will add. Scene-referred; result premultiplied.
// read    source   from split, layer 1, with levels, `as linear`
//         flat_source   instead of `source`, without levels, when no disc needs them: see the graph
//         discs    from split
// write   result   the mean of the far-field texels within the pixel's own disc whose discs reach the pixel; behind something nearer
//                  the mean of what is visible beside it. Alpha: how reliable that is. A depth test leaves 0 where split says `idle`
// params  see parameters.glsl
// defines POLYGON; FILL_SLOPE and FILL_START, see disc.glsl
//         TEXELS_PER_GAP   width of the texels to read for a gap of 1 between samples
#define NEAR 0
#ifdef HAS_FLAT_SOURCE
#define source flat_source
#define COARSEST 0.0
#else
#define COARSEST 16.0
#endif
uniform sampler2D source, discs;
#include "parameters.glsl"
out vec4 result;
#include "disc.glsl"
#include "rings.glsl"

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 own = texelFetch(source, pixel, 0);
  bool hidden = own.a <= 0.0;
  float radius = searchRadius(own.a, pixel, discs, largest), trust = hidden ? 1.0 : max(blurOf(2.0 * radius), 1e-3);
  // A level whose texels are as large as the gaps between the samples.
  int outermost = ringsFor(radius, rings);
  float samples = samplesTo(outermost);
  float level = clamp(ceil(log2(radius * inversesqrt(samples) * TEXELS_PER_GAP)), 0.0, COARSEST), texel = exp2(level);
  float shared_variance = 4.0 * fillVariance(radius) + 1.7 + 0.667 * texel * texel;
  float span = sqrt(max(radius * radius - shared_variance, 0.25)) + 0.5, radius_of_alpha = farRadius(1.0, largest);
  vec2 to_uv = 1.0 / vec2(textureSize(discs, 0)), middle = gl_FragCoord.xy * to_uv, start = kStart;
  vec4 sum = vec4(0.0);
  if (radius <= kLeastRadius) outermost = -1;
  if (hidden) span = 1.2 * radius + 1.0;  // the outermost ring is beyond the disc: wherever the near field is not whole, something is seen
  for (int ring = 0; ring <= outermost; ++ring) {
    int count = max(5 * ring, 1);
    float across = ringRadius(ring, span, samples);
    // Of squares: their difference is that of the lengths times 2 `across`, about. Gradually over a gap of 1 between rings.
    float per_difference = ring == 0 ? 4.0 : 0.5 / across;
    vec2 direction = start;
    start = startOfNext(start, ring);
    for (int i = 0; i < count; ++i) {
      vec2 at = across * direction;
      float share = 1.0;
#if POLYGON
      float shape = outline(direction);
      at *= shape;
      share = shape * shape;
#endif
      direction = turned(direction, kStep[ring]);
      vec4 c = textureLod(source, middle + at * to_uv, level);
      float disc = c.a * radius_of_alpha, blur = clamp(2.0 * disc - 0.5, 0.0, 1.0);
      float square = max(disc * disc - shared_variance, 0.25);
      share *= hidden ? 1.0 : blur * clamp((square - across * across) * per_difference + 0.65, 0.0, 1.0);
      sum += share / max(hidden ? c.a : c.a * (square + 1.0 / 12.0), 1e-7) * c;
    }
  }
  result = vec4((sum.a > 0.0 ? sum.rgb / sum.a : own.rgb / max(own.a, 1e-6)) * trust, trust);
}
