// The tiles that the near field reaches, a quad each; for the vertex shaders of that layer.
// read    tiles?   from reach; without it, all tiles
// params  tile     texels of the fields along a tile's side
#ifndef DOF_WORK_GLSL
#define DOF_WORK_GLSL

#include "common/tile_quad.glsl"

#ifdef HAS_TILES
uniform sampler2D tiles;
#endif

// `target` texels of a target for one of the fields. `everywhere`: also the tiles without work.
vec4 workCorner(int tile, int target, bool everywhere) {
  ivec2 fields = (ivec2(viewport) + target - 1) / target,
        grid = max((fields + tile - 1) / tile, ivec2(1)), at = tileOf(grid);
#ifdef HAS_TILES
  bool wanted = everywhere || texelFetch(tiles, at, 0).r > 0.0;
#else
  const bool wanted = true;
#endif
  return tileCorner(at, grid, tile * target, wanted);
}

#endif
