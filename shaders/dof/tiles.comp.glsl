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
  ivec2 size = textureSize(discs, 0), first = at * tile, end = min(first + tile, size);
  // Four texels at a time: sizes and tiles are even. The share is read only in rows with a part of the near field.
  int low = end.y, high = first.y;
  for (int y = first.y; y < end.y; y += 2) {
    vec4 radii = vec4(0.0);
    for (int x = first.x; x < end.x; x += 2) radii += textureGather(discs, vec2(x + 1, y + 1) / vec2(size));
    low = radii == vec4(0.0) ? low : min(low, y);
    high = radii == vec4(0.0) ? high : y + 2;
  }
  vec4 largest = vec4(0.0);
  for (int y = low; y < high; y += 2)
    for (int x = first.x; x < end.x; x += 2) {
      vec2 middle = vec2(x + 1, y + 1) / vec2(size);
      largest = max(largest, textureGather(discs, middle) / max(textureGather(source, middle, 3), 0.25));
    }
  imageStore(tiles, at, vec4(max(max(largest.x, largest.y), max(largest.z, largest.w))));
}
