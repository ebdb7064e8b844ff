// The tiles in which something moves half a pixel while the shutter is open.
// read    tiles            from motions; any sampler
// params  shutter, tile    as in gather.frag.glsl
#include "common/tile_quad.glsl"
#include "blur.glsl"

uniform sampler2D tiles;
layout(std140) uniform Parameters {
  float shutter;
  int samples;
  int tile;
};

void main() {
  ivec2 grid = textureSize(tiles, 0), at = tileOf(grid);
  gl_Position = tileCorner(at, grid, tile, tileMoves(texelFetch(tiles, at, 0).rg, viewport, shutter, tile));
}
