// The tiles that gather.frag.glsl reads: those in which gather.vert.glsl finds motion, and the eight around each, since no streak is longer
// than a tile.
// read    tiles            from motions; any sampler
// params  shutter, tile    as in gather.frag.glsl
#include "common/tile_quad.glsl"
#include "blur.glsl"

uniform sampler2D tiles;
layout(std140) uniform Parameters {
  float shutter;
  int tile;
};

void main() {
  ivec2 grid = textureSize(tiles, 0), at = tileOf(grid);
  bool moves = false;
  for (int i = 0; i < 9; ++i) {
    ivec2 beside = clamp(at + ivec2(i % 3 - 1, i / 3 - 1), ivec2(0), grid - 1);
    moves = moves || tileMoves(texelFetch(tiles, beside, 0).rg, viewport, shutter, tile);
  }
  gl_Position = tileCorner(at, grid, tile, moves);
}
