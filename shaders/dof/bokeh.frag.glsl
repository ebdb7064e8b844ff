// Blurs one layer of the half-size picture by its discs; fill adds the rest of the blur. Scene-referred; result premultiplied.
// read    source   from split, with levels, `as linear`
//         flat_source   instead of `source`, without levels, when no disc needs them: see the graph
//         discs    from split, with levels, `as linear`
//         tiles?   from reach: how far the near field reaches here (NEAR only); without
//                  it every pixel is searched as far as a tile
// write   result   NEAR 1: the near field, and as alpha how much of the pixel its discs cover
//                  NEAR 0: the mean of the far-field texels within the pixel's own disc whose discs reach the pixel; behind
//                  something nearer the mean of what is visible beside it. Alpha: how reliable that is. A depth test leaves 0
//                  where split says `idle`
// params  see parameters.glsl
// defines NEAR, default 0; POLYGON; FILL_SLOPE and FILL_START, see disc.glsl
//         TEXELS_PER_GAP   width of the texels to read for a gap of 1 between samples
#ifndef NEAR
#define NEAR 0
#endif
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

// Directions of 18 degrees, and of a step around the n-th ring.
const vec2 kStart = vec2(0.951056516, 0.309016994);
// From the fourth ring on each ring begins at another angle (the golden angle on), because equal beginnings would make spokes.
const vec2 kGolden = vec2(-0.737368878, 0.675490294);
const vec2 kStep[9] = vec2[9](vec2(1.0, 0.0), vec2(0.309016994, 0.951056516), vec2(0.809016994, 0.587785252), vec2(0.913545458, 0.406736643),
                              vec2(0.951056516, 0.309016994), vec2(0.968583161, 0.248689887), vec2(0.978147601, 0.207911691),
                              vec2(0.983930, 0.178557), vec2(0.987688341, 0.156434465));

#if POLYGON
float outline(vec2 direction) {
  float sector = 6.28318530717959 / float(blades), angle = atan(direction.y, direction.x);
  return cos(sector * 0.5) / cos(mod(angle, sector) - sector * 0.5);
}
#endif

// The n-th ring is this far out.
float ringRadius(int ring, float span, float samples) { return ring == 0 ? 0.0 : span * sqrt((1.0 + 2.5 * float(ring * ring)) / samples); }

// Does a disc reach so far? Gradually over the gap between two rings, of which there are `per_ring` to a texel: else discs would jump from
// ring to ring where the searched radius changes. The outermost ring of a disc of this size counts nearly whole, so that small discs are flatter.
float reaches(float disc, float across, float per_ring) { return clamp((disc - across) * per_ring + 0.65, 0.0, 1.0); }

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec2 to_uv = 1.0 / vec2(textureSize(discs, 0));
#if NEAR
  float radius = searchRadius(pixel);
  bool idle = radius <= 0.0;
#else
  vec4 own = texelFetch(source, pixel, 0);
  bool hidden = own.a <= 0.0;
  float radius = searchRadius(own.a, pixel, discs, largest);
  float trust = hidden ? 1.0 : max(blurOf(2.0 * radius), 1e-3);
  bool idle = radius <= kLeastRadius;
#endif
  // A level whose texels are as large as the gaps between the samples.
  int outermost = ringsFor(radius, rings);
  float samples = samplesTo(outermost);
  float level = clamp(ceil(log2(radius * inversesqrt(samples) * TEXELS_PER_GAP)), 0.0, COARSEST), texel = exp2(level);
#if NEAR
  float stride = fillStride(radius * inversesqrt(samples));
#else
  const float stride = 1.0;
#endif
  float shared_variance = 4.0 * stride * stride * fillVariance(radius) + 1.7 + 0.667 * texel * texel;
  float span = sqrt(max(radius * radius - shared_variance, 0.25)) + 0.5;
#if NEAR
  float per_ring = min(sqrt(samples / 2.5) / span, 1.0);
#endif
  float radius_of_alpha = farRadius(1.0, largest);
  vec2 middle = gl_FragCoord.xy * to_uv;
  vec3 sum = vec3(0.0);
  float weights = 0.0, area = 0.0;
  vec2 start = kStart;
  if (idle) outermost = -1;
  for (int ring = 0; ring <= outermost; ++ring) {
    int count = max(5 * ring, 1);
    float across = ringRadius(ring, span, samples);
#if !NEAR
    // reaches() for a gap of 1, of squares: their difference is that of the lengths times 2 `across`, about.
    float per_difference = ring == 0 ? 4.0 : 0.5 / across;
#endif
    vec2 direction = start, turn = kStep[ring];
    if (ring > 2) start = vec2(start.x * kGolden.x - start.y * kGolden.y, start.x * kGolden.y + start.y * kGolden.x);
    for (int i = 0; i < count; ++i) {
      vec2 at = across * direction;
      float share = 1.0;
#if POLYGON
      float shape = outline(direction);
      at *= shape;
      share = shape * shape;
      area += share;
#endif
      direction = vec2(direction.x * turn.x - direction.y * turn.y, direction.x * turn.y + direction.y * turn.x);
      at = middle + at * to_uv;
      vec4 c = textureLod(source, at, level);
#if NEAR
      float disc = textureLod(discs, at, level).r / max(c.a, 1e-4);
      float blur = blurOf(2.0 * disc);
      disc = sqrt(max(disc * disc - shared_variance, 0.25));
      // How many of the samples reach as far: those share the light of one texel, so that none is made or lost.
      float sharing = 0.0;
      for (int k = 0; k <= outermost; ++k) sharing += max(5.0 * float(k), 1.0) * reaches(disc, ringRadius(k, span, samples), per_ring);
      share *= blur * reaches(disc, across, per_ring) / sharing;
#else
      float disc = c.a * radius_of_alpha, blur = clamp(2.0 * disc - 0.5, 0.0, 1.0);
      float square = max(disc * disc - shared_variance, 0.25);
      share *= hidden ? 1.0 : blur * clamp((square - across * across) * per_difference + 0.65, 0.0, 1.0);
      share /= max(hidden ? c.a : c.a * (square + 1.0 / 12.0), 1e-7);
#endif
      sum += share * c.rgb;
      weights += share * c.a;
    }
  }
#if NEAR
#if POLYGON
  weights *= samples / max(area, 1e-4);
  sum *= samples / max(area, 1e-4);
#endif
  result = vec4(sum / max(weights, 1.0), min(weights, 1.0));
#else
  vec3 mean = weights > 0.0 ? sum / weights : own.rgb / max(own.a, 1e-6);
  result = vec4(mean * trust, trust);
#endif
}
