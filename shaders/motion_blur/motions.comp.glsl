// Up to four motions in a tile and the eight around it: the longest, then each time the one least like those before. All eight tiles count,
// whatever their direction: a superfluous motion costs time, a missed one cuts a streak off.
// read    tiles    screen UV per frame, from tile_max; any sampler
// write   result, more   the same size, two motions each; where there are fewer, the first again
// params  picture  pixels of the picture: tiles need not be square in UV
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D tiles;
layout(rgba16f) uniform writeonly image2D result;
layout(rgba16f) uniform writeonly image2D more;
layout(std140) uniform Parameters { vec2 picture; };

const float kAlike = 1.0;  // pixels a frame: gather finds motions so close to each other by itself

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), last = textureSize(tiles, 0) - 1;
  if (any(greaterThan(at, last))) return;
  vec2 found[4] = vec2[](vec2(0.0), vec2(0.0), vec2(0.0), vec2(0.0));
  for (int n = 0; n < 4; ++n) {
    float most = n == 0 ? 0.0 : kAlike * kAlike;
    vec2 next = found[0];
    for (int i = 0; i < 18; ++i) {
      vec4 both = texelFetch(tiles, clamp(at + ivec2(i % 3 - 1, i / 3 % 3 - 1), ivec2(0), last), 0);
      vec2 motion = i < 9 ? both.xy : both.zw;
      float least = 1e30;
      for (int k = 0; k < max(n, 1); ++k) {
        vec2 apart = (n == 0 ? motion : motion - found[k]) * picture;
        least = min(least, dot(apart, apart));
      }
      if (least > most) {
        most = least;
        next = motion;
      }
    }
    found[n] = next;
    // No two of these motions differ by as much: the first stands for all.
    if (n == 0 && 4.0 * most < kAlike * kAlike) {
      found = vec2[](next, next, next, next);
      break;
    }
  }
  imageStore(result, at, vec4(found[0], found[1]));
  imageStore(more, at, vec4(found[2], found[3]));
}
