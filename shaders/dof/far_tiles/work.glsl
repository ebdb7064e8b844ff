// The tiles of the far field, a quad each; for vertex shaders. See find.comp.glsl.
// defines FAR_TILE  texels of the fields along a tile's side
#ifndef DOF_FAR_TILES_WORK_GLSL
#define DOF_FAR_TILES_WORK_GLSL

#include "dof/coc.glsl"
#include "common/tile_quad.glsl"

// A tile's quad if its discs are alike, or if not. `scale`: pixels of the target along a texel of the fields.
vec4 farCorner(sampler2D tiles, int scale, bool alike) {
  ivec2 grid = textureSize(tiles, 0), at = tileOf(grid);
  float radius = texelFetch(tiles, at, 0).r;
  return tileCorner(at, grid, FAR_TILE * scale, alike ? radius > 0.0 : radius < 0.0);
}

#endif
