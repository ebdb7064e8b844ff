// The sample positions of the bokeh passes on a disc. In small discs each texel is one, as exact as the size of the fields allows. In
// others they are rings of 5, 10, 15 ... around the center, so that each sample covers the same area. Four neighboring pixels have four
// sets of samples, which the mean of the fill weighs equally: it sees four times as many samples (interleaved sampling; Keller and
// Heidrich, EGWR 2001). The includer defines takePlace().
#ifndef DOF_RINGS_GLSL
#define DOF_RINGS_GLSL

#include "disc.glsl"
#include "texels.glsl"

#ifndef RINGS
#define RINGS 1
#endif
#ifndef COARSEST
#define COARSEST 16.0
#endif

// How a disc is searched.
struct Search {
  int texels;             // each texel up to this distance to either side; -1: rings
  int outermost;          // ring; -1: each texel
  float samples;          // in all rings, or about as many texels
  float level;            // to read: its texels are as large as the gaps between the places of four pixels
  float shared_variance;  // four times what filtering adds to the variance of a disc
  float differs;          // 1: the four sets differ, else 0
  float shift;            // of this pixel's set across its ring, as a share of the ring's area
  float half_share;  // weight of a disc that ends at the sample: a half, in small discs more, so that they are flatter
  float span;  // radius of the area that the samples cover, texels of the fields
  ivec2 last;  // texel of the fields
  float roundness;  // radius of a round disc that has the area of the aperture's outline, of the radius of its corners
  Texels whole;     // the disc itself, where each texel is a place
};

// Takes a sample `across` texels of the fields from the pixel; `share` is its area, 1 for a round aperture. `each`: it is a texel, with its
// center at `at`.
void takePlace(Search search, bool each, vec2 at, float across, float share);

vec4 readPlace(sampler2D field, Search search, bool each, vec2 at) {
  return each ? texelFetch(field, clamp(ivec2(at), ivec2(0), search.last), 0)
              : textureLod(field, at / vec2(search.last + 1), search.level);
}

// The radius at which a disc ends in the samples, less what filtering adds; where each texel is one, of a round disc of the same area.
float reachOf(Search search, float radius) {
  if (search.texels < 0) return sqrt(max(radius * radius - search.shared_variance, 0.25));
  return reachInTexels(radius * search.roundness);
}

// Distance to either side at which texels may lie in a disc.
int texelsFor(Search search) {
  return texelsWithin(search.span / search.roundness);
}

// The set of this pixel, two numbers of 0 or 1. The first: in the outer half of the rings, and turned by a quarter of the step around the
// ring; in a checkerboard, because along rows or columns the rings and the pixels of a set would beat. The second: turned by two quarters.
vec2 whichSet() {
  vec2 at = floor(gl_FragCoord.xy);
  return step(0.25, fract(0.5 * vec2(at.x + at.y, at.y)));
}

// `filled`: the fill closes the gaps of this pixel.
Search searchOver(float radius, int rings, bool filled) {
  Search search;
  search.last = textureSize(source, 0) - 1;
  search.roundness = roundnessOf(blades);
  bool each = RINGS == 0 || radius <= EACH_TEXEL;
  // Where a pixel's own samples are too far apart, the sets differ. Then no level is finer than two pixels, the distance between pixels of
  // one set: so a texel counts equally in all sets.
  float gap = RINGS == 1 ? gapOf(radius, rings) : 0.0, variance = RINGS == 1 && filled ? fillVariance(radius, gap) : 0.0;
  search.differs = gap > FINE_GAP && filled ? 1.0 : 0.0;
  search.level = gap > FINE_GAP ? min(gap > kCoarseGap ? 2.0 : 1.0, COARSEST) : 0.0;
  search.shift = (whichSet().x - 0.5) * 0.5 * search.differs;
  search.half_share = 0.65 - 0.15 * clamp(0.5 * radius - 1.4, 0.0, 1.0);
  float texel = exp2(search.level);
  search.shared_variance = 4.0 * variance + (SCALE == 2 ? 1.7 : 0.7) + 0.667 * (2.0 * texel * texel - 1.0);
  search.texels = each ? 0 : -1;
  float reach = reachOf(search, radius);
  search.span = reach + 0.5;
  if (each) search.texels = texelsFor(search);
  search.outermost = each ? -1 : ringsFor(radius, rings);
  search.whole = texelsOf(reach);
  search.samples = each ? search.whole.sum : samplesTo(search.outermost);
  return search;
}

#if FIRST_RING != 5
#error the steps below are those of rings of 5, 10, 15 ... places
#endif
// Directions of 18 degrees, and of a step around the n-th ring.
const vec2 kStart = vec2(0.951056516, 0.309016994);
// From the fourth ring on, each ring starts at another angle (by the golden angle), because equal starts would make spokes.
const vec2 kGolden = vec2(-0.737368878, 0.675490294);
const vec2 kStep[9] =
    vec2[9](vec2(1.0, 0.0), vec2(0.309016994, 0.951056516), vec2(0.809016994, 0.587785252),
            vec2(0.913545458, 0.406736643), vec2(0.951056516, 0.309016994), vec2(0.968583161, 0.248689887),
            vec2(0.978147601, 0.207911691), vec2(0.983930, 0.178557), vec2(0.987688341, 0.156434465));

vec2 turned(vec2 direction, vec2 by) {
  return vec2(direction.x * by.x - direction.y * by.y, direction.x * by.y + direction.y * by.x);
}

// A quarter of that step, and in the middle a quarter of a turn.
const vec2 kQuarter[9] = vec2[9](
    vec2(0.0, 1.0), vec2(0.951056516, 0.309016994), vec2(0.987688341, 0.156434465),
    vec2(0.994521895, 0.104528463), vec2(0.996917334, 0.0784590957), vec2(0.998026728, 0.0627905195),
    vec2(0.998629535, 0.0523359562), vec2(0.998993067, 0.0448648304), vec2(0.999229036, 0.0392598158));

// Radius of the n-th ring.
float ringRadius(Search search, int ring) {
  float area = ring == 0 ? 0.5 * search.differs + search.shift
                         : 1.0 + float(FIRST_RING * ring) * (0.5 * float(ring) + search.shift);
  return search.span * sqrt(area / search.samples);
}

// Calls takePlace() for all samples; in the far field, where each texel is one, not for the pixel's own, whose share is 0. Returns the
// number of samples over the sum of their shares, the factor by which a disc would be too dark.
float takePlaces(Search search) {
#if NEAR
  float area = 0.0;
  int rows = search.texels;
#else
  float area = search.texels < 0 ? 0.0 : texelWithin(search.whole, 0.0);
  int rows = search.texels > 0 ? search.texels : -1;
#endif
  for (int y = -rows; y <= rows; ++y) {
    float span = search.span / search.roundness;
    int end = texelsWithin(sqrt(span * span - float(y * y)));
    for (int x = -end; x <= end; ++x) {
      vec2 offset = vec2(x, y);
      float across = acrossOf(offset, search.roundness, blades);
      float share = NEAR == 1 || across > 0.0 ? 1.0 : 0.0;
      area += share * texelWithin(search.whole, across);
      takePlace(search, true, gl_FragCoord.xy + offset, across, share);
    }
  }
  vec2 odd = whichSet() * search.differs, start = kStart;
  for (int ring = 0; ring <= search.outermost; ++ring) {
    int count = max(FIRST_RING * ring, 1);
    float across = ringRadius(search, ring);
    vec2 quarter = kQuarter[ring], half_step = turned(quarter, quarter);
    vec2 direction =
        turned(turned(start, mix(vec2(1.0, 0.0), quarter, odd.x)), mix(vec2(1.0, 0.0), half_step, odd.y));
    if (ring > 2) start = turned(start, kGolden);
    for (int i = 0; i < count; ++i) {
      vec2 at = across * direction;
      float share = 1.0;
#if POLYGON
      float shape = outline(direction, blades);
      at *= kUpright * shape;
      share = shape * shape;
#endif
      area += share;
      direction = turned(direction, kStep[ring]);
      takePlace(search, false, gl_FragCoord.xy + at, across, share);
    }
  }
  return search.samples / max(area, 1e-4);
}

#endif
