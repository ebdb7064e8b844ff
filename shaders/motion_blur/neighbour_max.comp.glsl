// The longest motion in a tile and the eight around it. All eight count, whatever their direction: a tile too many costs time,
// a missed one cuts a streak off.
// read    tiles    screen UV per frame, from tile_max; any sampler
// write   result   the same size
// params  picture  pixels of the picture: tiles need not be square in UV
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D tiles;
layout(rg16f) uniform writeonly image2D result;
layout(std140) uniform Parameters { vec2 picture; };

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), last = textureSize(tiles, 0) - 1;
  if (any(greaterThan(at, last))) return;
  vec2 longest = vec2(0.0);
  float length2 = 0.0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      vec2 v = texelFetch(tiles, clamp(at + ivec2(x, y), ivec2(0), last), 0).rg, pixels = v * picture;
      float l = dot(pixels, pixels);
      if (l > length2) {
        length2 = l;
        longest = v;
      }
    }
  imageStore(result, at, vec4(longest, 0.0, 0.0));
}
