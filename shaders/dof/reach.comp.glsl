// The search radius for the near field at the corners of each tile: the largest disc of the tiles around a corner. A tile sees the eight
// tiles around it (no other can reach it); interpolation between corners is never too small and continuous across tiles.
// read    tiles    from tiles; any sampler
// write   reach    the same size: the corners (0, 0), (1, 0), (0, 1) and (1, 1) of the tile; 0 where nothing reaches
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D tiles;
layout(rgba16f) uniform writeonly image2D reach;

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), last = textureSize(tiles, 0) - 1;
  if (any(greaterThan(at, last))) return;
  float own = 0.0;
  vec4 corners = vec4(0.0);
  for (int y = -2; y <= 2; ++y)
    for (int x = -2; x <= 2; ++x) {
      float disc = texelFetch(tiles, clamp(at + ivec2(x, y), ivec2(0), last), 0).r;
      if (max(abs(x), abs(y)) < 2) own = max(own, disc);
      bvec4 meets = bvec4(x < 2 && y < 2, x > -2 && y < 2, x < 2 && y > -2, x > -2 && y > -2);
      corners = max(corners, disc * vec4(meets));
    }
  imageStore(reach, at, own > 0.0 ? corners : vec4(0.0));
}
