// A round of jump flooding: what the eight pixels `hop` away know.
// read    before    pixel, or -1
// write   nearest   the same
uniform sampler2D before;
layout(std140) uniform Parameters { int hop; };
out vec2 nearest;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy), size = textureSize(before, 0);
  nearest = vec2(-1.0);
  float shortest = 1e30;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      ivec2 p = at + hop * ivec2(x, y);
      if (any(lessThan(p, ivec2(0))) || any(greaterThanEqual(p, size))) continue;
      vec2 known = texelFetch(before, p, 0).rg;
      float way = distance(known, vec2(at));
      if (known.x >= 0.0 && way < shortest) {
        shortest = way;
        nearest = known;
      }
    }
}
