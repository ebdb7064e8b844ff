// The largest disc before the focus in a tile and the eight around it: no other can reach into the tile.
// read    tiles    from tiles; any sampler
// write   reach    the same size
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D tiles;
layout(r16f) uniform writeonly image2D reach;

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), last = textureSize(tiles, 0) - 1;
  if (any(greaterThan(at, last))) return;
  float largest = 0.0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) largest = max(largest, texelFetch(tiles, clamp(at + ivec2(x, y), ivec2(0), last), 0).r);
  imageStore(reach, at, vec4(largest));
}
