// The tiles that discs below kLarge reach.
// read    tiles    from far_tiles
// defines FAR_TILE  texels of the fields along a tile's side
#include "dof/coc.glsl"
#include "common/tile_quad.glsl"

uniform sampler2D tiles;

void main() {
  ivec2 grid = textureSize(tiles, 0), at = tileOf(grid);
  gl_Position = tileCorner(at, grid, FAR_TILE * SCALE, texelFetch(tiles, at, 0).g > 0.0);
}
