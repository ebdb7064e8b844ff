// The largest disc of the near field in each tile.
// read    discs    from split: radii in its pixels, times the share of the near field
//         source   from split: that share is its alpha
// write   tiles    one texel per tile
// params  tile     pixels along a tile's side
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D discs, source;
layout(r16f) uniform writeonly image2D tiles;
layout(std140) uniform Parameters {
  int tile;
};

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, imageSize(tiles)))) return;
  ivec2 first = at * tile, end = min(first + tile, textureSize(discs, 0));
  float largest = 0.0;
  for (int y = first.y; y < end.y; ++y)
    for (int x = first.x; x < end.x; ++x)
      largest =
          max(largest, texelFetch(discs, ivec2(x, y), 0).r / max(texelFetch(source, ivec2(x, y), 0).a, 0.25));
  imageStore(tiles, at, vec4(largest));
}
