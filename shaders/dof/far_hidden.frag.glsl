// The far field, at the size of the fields, where the near field hides all of it, from what is visible beside the nearer surface, within its
// disc: the nearest where the far field is sharp, above all what goes on from one side to the other; the mean where its discs are as large.
// Scene-referred; result premultiplied.
// read    see far_layer.glsl
//         tiles?   from reach, for the vertex shader
// modify  result   alpha 1, or 0 where nothing is visible beside a disc: there the sharp picture stays. A depth test skips all else: see
//                  split
#include "far_layer.glsl"
out vec4 result;

vec4 all = vec4(0.0);  // that is visible within the disc, a sum
float radii = 0.0;     // of its discs, a sum

struct Side {
  vec4 seen;   // alpha 1, or all of it 0
  float away;  // texels of the fields
};

// What is visible first in a direction.
Side sideOf(vec2 direction, float disc) {
  vec4 seen = vec4(0.0);
  float away = 0.0;
  // The last place is near the edge of the disc or beyond it: except for the smallest discs, something is visible wherever the near field is
  // not opaque.
  for (float across = 1.4; across < 1.2 * disc + 1.5; across *= 1.4) {
    ivec2 place = clamp(ivec2(gl_FragCoord.xy + across * direction), ivec2(0), textureSize(source, 0) - 1);
    vec4 c = texelFetch(source, place, 0);
    float share = max(c.a, 1e-7), first = 1.0 - seen.a;
    c /= share;
    all += across * across * c;
    radii += across * across * texelFetch(discs, place, 0).g / share;
    seen += first * c;
    away += first * c.a * across;
  }
  return Side(seen, away);
}

void main() {
  float disc = texelFetch(discs, ivec2(gl_FragCoord.xy), 0).r;
  vec4 seen = vec4(0.0);
  vec2 direction = vec2(1.0, 0.0);
  // Eight lines through the pixel. One whose two sides are alike counts most: a horizon stays one.
  for (int i = 0; i < 8; ++i) {
    Side a = sideOf(direction, disc), b = sideOf(-direction, disc);
    vec3 unlike = abs(a.seen.rgb - b.seen.rgb) / max(a.seen.rgb + b.seen.rgb, vec3(1e-3));
    float most = max(unlike.r, max(unlike.g, unlike.b));
    vec2 far2 = max(vec2(a.away * a.away, b.away * b.away), vec2(1.0)), near4 = 1.0 / (far2 * far2);
    seen += (a.seen * near4.x + b.seen * near4.y) / (0.02 + most * most);
    direction = vec2(direction.x * 0.92387953 - direction.y * 0.38268343, direction.x * 0.38268343 + direction.y * 0.92387953);
  }
  if (seen.a > 0.0) seen = mix(seen / seen.a, all / all.a, clamp(2.0 * radii / max(all.a * disc, 1e-7) - 1.0, 0.0, 1.0));
  result = vec4(seen.rgb, seen.a > 0.0 ? 1.0 : 0.0);
}
