// The tiles of a coarser level that the near field reaches; elsewhere the level is empty unless the far field has discs that need it.
// read    tiles?   from reach
// params  tile     texels of the fields along a tile's side
//         everywhere   1: all tiles
//         level    each texel of which is 2^level of these wide
layout(std140) uniform Parameters {
  int tile;
  int level;
  int everywhere;
};
#include "work.glsl"

void main() { gl_Position = workCorner(tile >> level, 1, everywhere == 1); }
