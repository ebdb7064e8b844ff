// The far field at the size of the fields, each surface blurred over its discs, except for the part that fill adds. Scene-referred; result
// premultiplied.
// read    source   from split, layer 1, with levels, `as linear`
//         discs    from split, with levels, `as linear`
//         flat_source, flat_discs   instead of these, without levels, when no disc needs them: see the graph
// write   result   the surfaces in front of the pixel's own, by what their discs cover; in the rest its own and what shows behind it.
//                  Alpha: confidence. A depth test skips pixels that split marked idle, or behind the near field: see far_hidden.frag.glsl
// params  see parameters.glsl
// defines POLYGON
#include "far_layer.glsl"
#include "parameters.glsl"
out vec4 result;
#include "rings.glsl"

// Nearer surfaces have smaller discs. How much a disc counts as in front of another, and how much as behind; `ratio` of their radii.
// Similar radii are one surface.
float liesOver(float ratio) {
  return 1.0 - smoothstep(0.75, 0.92, ratio);
}
float liesBehind(float ratio) {
  return smoothstep(1.1, 1.3, ratio);
}

float own_radius = 0.0, per_radius = 0.0;
vec4 over = vec4(0.0), own = vec4(0.0), behind = vec4(0.0);  // premultiplied light of the discs that reach here
float unseen = 0.0;  // the part hidden in texels shared with nearer surfaces: see split

void takePlace(Search search, bool each, vec2 at, float across, float share) {
  vec4 c = readPlace(source, search, each, at);
  float disc = readPlace(discs, search, each, at).g / max(c.a, 1e-4);
  // A hidden surface is seen through the same part of the lens as what hides it, so it counts as if its disc were no larger.
  float reach = reachOf(search, min(disc, own_radius)), light = share;
  if (each) {
    Texels texels = texelsOf(reach);
    light *= texelWithin(texels, across) / texels.sum;
  } else {
    // Gradually over a texel.
    light *= clamp(reach - across + search.half_share, 0.0, 1.0) * search.span * search.span /
             (search.samples * (reach * reach + 1.0 / 12.0));
  }
  float is_over = liesOver(disc * per_radius), is_behind = liesBehind(disc * per_radius);
  vec4 lit = light * c;
  over += is_over * fieldShare(float(SCALE) * disc) * lit;
  behind += is_behind * lit;
  own += (1.0 - is_over - is_behind) * lit;
  unseen += (1.0 - is_behind) * min(4.0 * c.a, 1.0) * (light - lit.a);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 middle = texelFetch(source, pixel, 0);
  float own_share = middle.a;
  own_radius = texelFetch(discs, pixel, 0).g / max(own_share, 1e-4);
  per_radius = 1.0 / max(own_radius, 1e-4);
  Search search = searchOver(own_radius, rings, true);
  if (own_radius <= kLeastRadius) search.texels = search.outermost = -1;
  if (search.texels >= 0) {
    Texels texels = texelsOf(reachOf(search, own_radius));
    float light = texelWithin(texels, 0.0) / texels.sum;
    own = light * middle;
    unseen = light * min(4.0 * own_share, 1.0) * (1.0 - own_share);
  }
  float shape = takePlaces(search);
  over *= shape;
  over /= max(over.a, 1.0);
  // The rest shows what is behind the own surface, as far as that is visible. In a gap so narrow that surfaces share each of its texels, it
  // is visible only farther away: in the eight texels at a distance of two.
  float rest = 1.0 - over.a, seen = shape * (behind.a + unseen);
  for (int i = 0; i < (unseen > 0.0 && behind.a <= 0.0 && search.texels >= 0 && liesBehind(largest_far * per_radius) > 0.0 ? 9 : 0); ++i) {
    ivec2 at = clamp(pixel + 2 * ivec2(i % 3, i / 3) - 2, ivec2(0), textureSize(source, 0) - 1);
    vec4 c = texelFetch(source, at, 0);
    behind += liesBehind(texelFetch(discs, at, 0).g / max(c.a, 1e-4) * per_radius) * c;
  }
  float beside = behind.a > 0.0 ? clamp(rest - shape * own.a, 0.0, seen) : 0.0;
  vec3 light = over.rgb + own.rgb * ((rest - beside) / max(own.a, 1e-7)) + behind.rgb * (beside / max(behind.a, 1e-7));
  float trust = max(fieldShare(float(SCALE) * own_radius), 1e-3);
  result = vec4(light * trust, trust);
}
