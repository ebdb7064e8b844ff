// The far field, at the size of the fields, where the near field hides all of it: the mean of what is visible beside the nearer surface,
// within its disc. Scene-referred; result premultiplied.
// read    see far_layer.glsl
//         tiles?   from reach, for the vertex shader
// modify  result   alpha 1, or 0 where nothing is visible beside a disc below three pixels: there the sharp picture stays. A depth test
//                  skips all else: see split
// params  see parameters.glsl
// defines POLYGON
#include "far_layer.glsl"
#include "parameters.glsl"
out vec4 result;
#include "rings.glsl"

vec4 seen = vec4(0.0);

void takePlace(Search search, bool each, vec2 at, float across, float share) {
  vec4 c = readPlace(source, search, each, at);
  seen += c / max(c.a, 1e-7);
}

void main() {
  float disc = texelFetch(discs, ivec2(gl_FragCoord.xy), 0).r;
  Search search = searchOver(disc, rings);
  // The outermost sample is beyond the disc: except for the smallest discs, something is visible wherever the near field is not opaque.
  search.span = 1.2 * disc + 1.0;
  if (search.texels >= 0) search.texels = texelsFor(search);
  takePlaces(search);
  // Small discs leave gaps, through which the background shows in part, see far_field.frag.glsl. Behind larger ones the sharp picture must
  // not show: the near field covers it except for rounding, which a bright light would turn into a spot.
  float trust = seen.a > 0.0 || float(SCALE) * disc >= 3.0 ? 1.0 : 0.0;
  result = vec4(seen.rgb / max(seen.a, 1e-7), trust);
}
