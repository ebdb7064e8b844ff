// Draws the tiles that the disc of a highlight may reach: those that have highlights, and the eight around each. No disc reaches
// farther, because a tile is at least as wide as the radius of the largest disc.
// read    highlights   from find
// params  see draw.frag.glsl
#include "common/tile_quad.glsl"
#include "dof/coc.glsl"
#include "parameters.glsl"

void main() {
  ivec2 at = tileOf(grid);
  float count = 0.0;
  for (int i = 0; i < 9; ++i) {
    ivec2 there = at + ivec2(i % 3, i / 3) - 1;
    if (there == clamp(there, ivec2(0), grid - 1)) count += lists[there.y * grid.x + there.x].count.x;
  }
  gl_Position = tileCorner(at, grid, tile * SCALE, count > 0.0);
}
