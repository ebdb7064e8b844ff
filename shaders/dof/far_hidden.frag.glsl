// The far field, at the size of the fields, where the near field hides all of it: what is visible beside the nearer surface, within its
// disc; the nearest where the far field is sharp, the mean where its discs are as large. Scene-referred; result premultiplied.
// read    see far_layer.glsl
//         tiles?   from reach, for the vertex shader
// modify  result   alpha 1, or 0 where nothing is visible beside a disc: there the sharp picture stays. A depth test skips all else: see
//                  split
#include "far_layer.glsl"
out vec4 result;

vec2 turned(vec2 direction, vec2 by) {
  return vec2(direction.x * by.x - direction.y * by.y, direction.x * by.y + direction.y * by.x);
}

void main() {
  float disc = texelFetch(discs, ivec2(gl_FragCoord.xy), 0).r;
  ivec2 last = textureSize(source, 0) - 1;
  vec4 seen = vec4(0.0), all = vec4(0.0);
  float radii = 0.0;
  vec2 direction = vec2(1.0, 0.0);
  // Rings of eight places, from the innermost on: once four places of a ring have seen something, those farther out do not count to the
  // nearest. The last is near the edge of the disc or beyond it: except for the smallest discs, something is visible wherever the near field
  // is not opaque.
  for (float across = 1.4; across < 1.2 * disc + 1.5; across *= 1.3) {
    vec4 ring = vec4(0.0);
    for (int i = 0; i < 8; ++i) {
      ivec2 place = clamp(ivec2(gl_FragCoord.xy + across * direction), ivec2(0), last);
      vec4 c = texelFetch(source, place, 0);
      ring += c / max(c.a, 1e-7);
      radii += across * across * texelFetch(discs, place, 0).g / max(c.a, 1e-7);
      direction = turned(direction, vec2(0.70710678, 0.70710678));
    }
    all += across * across * ring;
    seen += ring * ((1.0 - seen.a) * min(0.25, 1.0 / max(ring.a, 1.0)));
    direction = turned(direction, vec2(0.92387953, 0.38268343));
  }
  if (seen.a > 0.0) seen = mix(seen / seen.a, all / all.a, clamp(2.0 * radii / max(all.a * disc, 1e-7) - 1.0, 0.0, 1.0));
  result = vec4(seen.rgb / max(seen.a, 1e-7), seen.a > 0.0 ? 1.0 : 0.0);
}
