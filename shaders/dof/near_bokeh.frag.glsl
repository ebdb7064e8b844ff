// The near field at the size of the fields, each surface blurred over its discs, except for the part that fill adds. Scene-referred; result
// premultiplied.
// read    source   from split, layer 0, with levels, `as linear`
//         discs    from split, with levels, `as linear`
//         tiles?   from reach: how far the near field reaches here; without it every pixel is searched as far as a tile
// write   result   the near field and how much of the pixel it covers
// params  see parameters.glsl
// defines POLYGON
#define NEAR 1
uniform sampler2D source, discs;
#include "parameters.glsl"
out vec4 result;
#include "rings.glsl"

// Nearer surfaces have larger discs. How much a disc counts as in front of one of the radius `own`, and how much as behind. Similar radii
// are one surface.
float liesOver(float disc, float own) {
  return own > 0.0 ? smoothstep(1.3 * own, 1.8 * own, disc) : step(1e-6, disc);
}
float liesBehind(float disc, float own) {
  return own > 0.0 ? 1.0 - smoothstep(0.55 * own, 0.75 * own, disc) : 0.0;
}

float per_ring = 1.0;

// Whether a disc reaches this far, gradually over the gap between two rings (`per_ring` to a texel): else discs would jump from ring to
// ring where the search radius changes.
float reachesRing(Search search, float disc, float across) {
  return clamp((disc - across) * per_ring + search.half_share, 0.0, 1.0);
}
float reaches(Search search, bool each, Texels disc, float across) {
  return each ? texelWithin(disc, across) : reachesRing(search, disc.radius, across);
}

struct Gathered {
  vec4 spread;    // premultiplied light of the discs that reach here; alpha may be above 1
  vec4 behind;    // visible behind or beside the own surface, in the near field: a sum
  float farther;  // the same outside of the near field: a number of samples
  float places;   // within the own disc
};

// The gathered light of a pixel whose own disc has the radius `own_radius` (0: not in the near field). `over`: of surfaces in front of the
// own surface, else of this surface.
Gathered all;
float own_radius = 0.0;
Texels own_disc = Texels(0.0, 0.0, 0.0, 0.0);
bool over = true;

void takePlace(Search search, bool each, vec2 at, float across, float share) {
  vec4 c = readPlace(source, search, each, at);
  float disc = readPlace(discs, search, each, at).r / max(c.a, 1e-4);
  Texels spread = texelsOf(reachOf(search, disc));
  // The number of samples that reach this far: they share the light of one texel, so the total is kept.
  float sharing = each ? spread.sum : 0.0;
  for (int k = 0; k <= search.outermost; ++k)
    sharing += float(max(FIRST_RING * k, 1)) * reachesRing(search, spread.radius, ringRadius(search, k));
  share *= reaches(search, each, spread, across) / sharing;
  float is_over = liesOver(disc, own_radius);
  if (over) {
    all.spread += is_over * fieldShare(float(SCALE) * disc) * share * c;
  } else {
    float is_behind = liesBehind(disc, own_radius), seen = reaches(search, each, own_disc, across);
    all.spread += (1.0 - is_over - is_behind) * share * c;
    all.behind += seen * is_behind * c;
    all.farther += seen * (1.0 - c.a);
    all.places += seen;
  }
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float radius = searchRadius(pixel);
  own_radius = ownDisc(pixel);
  result = vec4(0.0);
  for (int layer = 0; layer < 2; ++layer) {
    over = layer == 0;
    if (over ? radius <= 1.3 * own_radius : own_radius <= 0.0) continue;
    // The fill is as wide as the own disc asks for.
    Search search = searchOver(over ? radius : min(radius, 1.4 * own_radius), rings, !over || own_radius <= 0.0);
    per_ring = min(sqrt(search.samples / (0.5 * float(FIRST_RING))) / search.span, 1.0);
    own_disc = texelsOf(reachOf(search, own_radius));
    all = Gathered(vec4(0.0), vec4(0.0), 0.0, 0.0);
    all.spread *= takePlaces(search);
    if (over) {
      result = all.spread / max(all.spread.a, 1.0);
      continue;
    }
    // The shares add up as long as they fit, as for one slanted surface. The own surface and what is visible beside it divide the rest.
    float rest = 1.0 - result.a, beside = all.behind.a + all.farther;
    float seen = beside / all.places, hidden = rest * seen / max(seen + min(all.spread.a, rest), 1e-6);
    float own_share = rest - hidden;
    vec4 shown = all.spread * (own_share / max(all.spread.a, 1e-6)) + all.behind * (hidden / max(beside, 1e-6));
    // Beside something nearer all of it: pixels of that have a part of this texel, and nothing else to show there.
    result += max(fieldShare(float(SCALE) * own_radius), min(4.0 * result.a, 1.0)) * shown;
  }
}
