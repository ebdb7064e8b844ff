// The far field at half size, spread over its discs but for what fill will add. Scene-referred; result premultiplied.
// read    source   from split, layer 1, with levels, `as linear`
//         flat_source   instead of `source`, without levels, when no disc needs them: see the graph
//         discs    from split
// write   result   the mean of the far-field texels within the pixel's own disc whose discs reach the pixel; behind something nearer
//                  the mean of what is visible beside it. Alpha: how reliable that is. A depth test leaves 0 where split says `idle`
// params  see parameters.glsl
// defines POLYGON
#define NEAR 0
#ifdef HAS_FLAT_SOURCE
#define source flat_source
#define COARSEST 0.0
#endif
uniform sampler2D source, discs;
#include "parameters.glsl"
out vec4 result;
#include "rings.glsl"

float radius_of_alpha = 0.0;
bool hidden = false;
vec4 sum = vec4(0.0);

void takePlace(Search search, vec2 at, float across, float share) {
  vec4 c = textureLod(source, at, search.level);
  float disc = c.a * radius_of_alpha, blur = clamp(2.0 * disc - 0.5, 0.0, 1.0);
  float square = max(disc * disc - search.shared_variance, 0.25);
  // Of squares: their difference is that of the lengths times 2 `across`, about. Gradually over a gap of 1 between rings.
  float per_difference = min(0.5 / max(across, 0.125), 4.0);
  share *=
      hidden ? 1.0 : blur * clamp((square - across * across) * per_difference + search.half_share, 0.0, 1.0);
  sum += share / max(hidden ? c.a : c.a * (square + 1.0 / 12.0), 1e-7) * c;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 own = texelFetch(source, pixel, 0);
  hidden = own.a <= 0.0;
  radius_of_alpha = farRadius(1.0, largest);
  float radius = searchRadius(own.a, pixel, discs, largest),
        trust = hidden ? 1.0 : max(blurOf(2.0 * radius), 1e-3);
  Search search = searchOver(radius, rings);
  if (radius <= kLeastRadius) search.outermost = -1;
  if (hidden)
    search.span =
        1.2 * radius +
        1.0;  // the outermost ring is beyond the disc: wherever the near field is not whole, something is seen
  takePlaces(search, 1.0 / vec2(textureSize(discs, 0)));
  result = vec4((sum.a > 0.0 ? sum.rgb / sum.a : own.rgb / max(own.a, 1e-6)) * trust, trust);
}
