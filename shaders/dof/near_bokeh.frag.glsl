// The near field at half size, each surface spread over its discs but for what fill will add. Scene-referred; result premultiplied.
// read    source   from split, layer 0, with levels, `as linear`
//         discs    from split, with levels, `as linear`
//         tiles?   from reach: how far the near field reaches here; without it every pixel is searched as far as a tile
// write   result   the near field and how much of the pixel it covers
// params  see parameters.glsl
// defines POLYGON; FILL_SLOPE and FILL_START, see disc.glsl
//         TEXELS_PER_GAP   width of the texels to read for a gap of 1 between samples
#define NEAR 1
uniform sampler2D source, discs;
#include "parameters.glsl"
out vec4 result;
#include "disc.glsl"
#include "rings.glsl"

// Nearer things have larger discs: how much a disc lies over one of the radius `own`, and how much behind it. In between is one surface.
float liesOver(float disc, float own) { return smoothstep(1.3 * own, 1.8 * own, disc); }
float liesBehind(float disc, float own) { return 1.0 - smoothstep(0.55 * own, 0.75 * own, disc); }

// Does a disc reach so far? Gradually over the gap between two rings, of which there are `per_ring` to a texel: else discs would jump from
// ring to ring where the searched radius changes. The outermost ring of a disc of this size counts nearly whole, so that small discs are flatter.
float reaches(float disc, float across, float per_ring) { return clamp((disc - across) * per_ring + 0.65, 0.0, 1.0); }

struct Gathered {
  vec4 spread;    // premultiplied light of the discs that reach here; alpha may be above 1
  vec4 behind;    // what lies behind the own surface and is seen beside it: sum of what is in the near field
  float farther;  // the same of what is not: a number of places
  float places;   // within the own disc
};

// What reaches a pixel whose own disc has the radius `own` (0: not in the near field), from places within `radius`, half-size pixels.
// `over`: of what lies over the own surface, else of this surface.
Gathered gather(float radius, float own, bool over) {
  int outermost = ringsFor(radius, rings);
  float samples = samplesTo(outermost);
  // A level whose texels are as large as the gaps between the samples.
  float level = max(ceil(log2(radius * inversesqrt(samples) * TEXELS_PER_GAP)), 0.0), texel = exp2(level);
  float stride = fillStride(radius * inversesqrt(samples));
  float shared_variance = 4.0 * stride * stride * fillVariance(radius) + 1.7 + 0.667 * texel * texel;
  float span = sqrt(max(radius * radius - shared_variance, 0.25)) + 0.5, per_ring = min(sqrt(samples / 2.5) / span, 1.0);
  float own_reach = sqrt(max(own * own - shared_variance, 0.25));
  Gathered all = Gathered(vec4(0.0), vec4(0.0), 0.0, 0.0);
  vec2 to_uv = 1.0 / vec2(textureSize(discs, 0)), middle = gl_FragCoord.xy * to_uv, start = kStart;
  float area = 0.0;
  for (int ring = 0; ring <= outermost; ++ring) {
    int count = max(5 * ring, 1);
    float across = ringRadius(ring, span, samples);
    vec2 direction = start;
    start = startOfNext(start, ring);
    for (int i = 0; i < count; ++i) {
      vec2 at = across * direction;
      float share = 1.0;
#if POLYGON
      float shape = outline(direction);
      at *= shape;
      share = shape * shape;
      area += share;
#endif
      direction = turned(direction, kStep[ring]);
      at = middle + at * to_uv;
      vec4 c = textureLod(source, at, level);
      float disc = textureLod(discs, at, level).r / max(c.a, 1e-4), reach = sqrt(max(disc * disc - shared_variance, 0.25));
      // How many of the samples reach as far: those share the light of one texel, so that none is made or lost.
      float sharing = 0.0;
      for (int k = 0; k <= outermost; ++k) sharing += max(5.0 * float(k), 1.0) * reaches(reach, ringRadius(k, span, samples), per_ring);
      share *= blurOf(2.0 * disc) * reaches(reach, across, per_ring) / sharing;
      float is_over = liesOver(disc, own);
      if (over) {
        all.spread += is_over * share * c;
      } else {
        float is_behind = liesBehind(disc, own), seen = reaches(own_reach, across, per_ring);
        all.spread += (1.0 - is_over - is_behind) * share * c;
        all.behind += seen * is_behind * c;
        all.farther += seen * (1.0 - c.a);
        all.places += seen;
      }
    }
  }
#if POLYGON
  all.spread *= samples / max(area, 1e-4);
#endif
  return all;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float radius = searchRadius(pixel), own = texelFetch(discs, pixel, 0).r;
  vec4 over = vec4(0.0);
  if (radius > 1.3 * own) over = gather(radius, own, true).spread;
  over /= max(over.a, 1.0);
  result = over;
  if (own > 0.0) {
    Gathered same = gather(min(radius, 1.4 * own), own, false);
    // The shares add up as long as they fit, as those of one slanted surface do. Where the own surface does not fill the rest, what is seen
    // beside it stands in for what it hides: no more than is seen.
    float beside = same.behind.a + same.farther;
    float hidden = min(1.0 - over.a - min(same.spread.a, 1.0 - over.a), beside / same.places), own_share = 1.0 - over.a - hidden;
    result += same.spread * (own_share / max(same.spread.a, 1e-6)) + same.behind * (hidden / max(beside, 1e-6));
  }
}
