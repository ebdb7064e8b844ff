// The far field at half size, each surface spread over its discs but for what fill will add. Scene-referred; result premultiplied.
// read    source   from split, layer 1, with levels, `as linear`
//         discs    from split, with levels, `as linear`
//         flat_source, flat_discs   instead of these, without levels, when no disc needs them: see the graph
// write   result   the surfaces before the pixel's own, as much as their discs cover; in the rest its own and what is seen behind it. Behind the near
//                  field the mean of what is visible beside it. Alpha: how reliable that is. A depth test leaves 0 where split says `idle`
// params  see parameters.glsl
// defines POLYGON
#define NEAR 0
#ifdef HAS_FLAT_SOURCE
#define source flat_source
#define discs flat_discs
#define COARSEST 0.0
#endif
uniform sampler2D source, discs;
#include "parameters.glsl"
out vec4 result;
#include "rings.glsl"

// Nearer things have smaller discs: how much a disc lies over one of the radius `own`, and how much behind it. In between is one surface.
float liesOver(float disc, float own) {
  return 1.0 - smoothstep(0.75 * own, 0.92 * own, disc);
}
float liesBehind(float disc, float own) {
  return smoothstep(1.1 * own, 1.3 * own, disc);
}

bool hidden = false;
float own_radius = 0.0;
vec4 over = vec4(0.0), own = vec4(0.0), behind = vec4(0.0);  // premultiplied light of the discs that reach here
float unseen = 0.0;  // what is hidden in texels that nearer surfaces share: see split

// Gradually over a texel.
float reaches(Search search, bool each, float disc, float across) {
  return each ? texelWithin(disc, across) : clamp(disc - across + search.half_share, 0.0, 1.0);
}

void takePlace(Search search, bool each, vec2 at, float across, float share) {
  vec4 c = readPlace(source, search, each, at);
  float disc = readPlace(discs, search, each, at).g / max(c.a, 1e-4);
  // What is behind is seen through the same gap of the lens as what hides it: so it counts as if its disc were no larger.
  float reach = reachOf(search, min(disc, own_radius));
  float sharing =
      each ? texelsWithin(reach) : search.samples * (reach * reach + 1.0 / 12.0) / (search.span * search.span);
  float light = hidden ? 1.0 / max(c.a, 1e-7) : share * reaches(search, each, reach, across) / sharing,
        is_over = hidden ? 0.0 : liesOver(disc, own_radius),
        is_behind = hidden ? 0.0 : liesBehind(disc, own_radius);
  over += is_over * light * c;
  own += (1.0 - is_over - is_behind) * light * c;
  behind += is_behind * light * c;
  unseen += (1.0 - is_behind) * light * min(4.0 * c.a, 1.0) * (1.0 - c.a);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float own_share = texelFetch(source, pixel, 0).a;
  hidden = own_share <= 0.0;
  own_radius = searchRadius(own_share, texelFetch(discs, pixel, 0).rg);
  Search search = searchOver(own_radius, rings);
  // The outermost place is beyond the disc: wherever the near field is not whole, something is seen.
  if (hidden) {
    search.span = 1.2 * own_radius + 1.0;
    if (search.texels >= 0) search.texels = texelsFor(search);
  }
  if (own_radius <= kLeastRadius) search.texels = search.outermost = -1;
  float shape = takePlaces(search);
  over *= shape;
  over /= max(over.a, 1.0);
  // What the own surface leaves is what is behind it, as far as that is seen. In a gap between things so narrow that they share each texel of it,
  // that is seen farther away only: of the texels two away, eight.
  float rest = 1.0 - over.a, seen = shape * (behind.a + unseen);
  for (int i = 0; i < (unseen > 0.0 && behind.a <= 0.0 && search.texels >= 0 ? 9 : 0); ++i) {
    ivec2 at = clamp(pixel + 2 * ivec2(i % 3, i / 3) - 2, ivec2(0), textureSize(source, 0) - 1);
    vec4 c = texelFetch(source, at, 0);
    behind += liesBehind(texelFetch(discs, at, 0).g / max(c.a, 1e-4), own_radius) * c;
  }
  float beside = behind.a > 0.0 ? clamp(rest - shape * own.a, 0.0, seen) : 0.0;
  vec3 light = over.rgb + own.rgb * ((rest - beside) / max(own.a, 1e-7)) + behind.rgb * (beside / max(behind.a, 1e-7));
  float trust = hidden ? 1.0 : max(blurOf(2.0 * own_radius), 1e-3);
  result = vec4(light * trust, trust);
}
