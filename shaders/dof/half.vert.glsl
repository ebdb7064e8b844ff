// The tiles of a coarser level that the near field reaches; elsewhere the level is empty.
// read    tiles?   from reach; without it all of the level
// params  tile     texels of the fields along a tile's side
//         level    each texel of which is 2^level of these wide
layout(std140) uniform Parameters {
  int tile;
  int level;
};
#include "work.glsl"

void main() { gl_Position = workCorner(tile >> level, 1); }
