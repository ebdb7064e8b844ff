// Spheres sorted by the cells of a grid over the box of their centers. A shader finds the spheres near a place without
// testing all spheres. Cells are cubes. A sphere belongs to the cell of its center, unless it is large: its radius is
// over twice the geometric mean of all radii. Large spheres belong to one more cell, the last, which every search
// includes.
// grid   buffer; the define GRID_ACCESS is its qualifier, readonly by default
#ifndef NEIGHBORS_GRID_GLSL
#define NEIGHBORS_GRID_GLSL

#ifndef GRID_ACCESS
#define GRID_ACCESS readonly
#endif

layout(std430) GRID_ACCESS buffer grid {
  vec4 grid_low;     // xyz: least corner of the box; w: side of a cell
  uvec4 grid_cells;  // xyz: how many cells there are along x, y and z; w: how many in all
  vec4 grid_radii;   // x: the greatest radius of spheres that are not large; y: the radius from which a sphere is large
  uint grid_word[];  // a word per cell: the end of its spheres in what follows; from word `cells` + 1 on: rows of
                     // spheres, cell by cell
};

// `low` and `many` are grid_low and grid_cells. A shader reads these once, outside of loops and before any return:
// elsewhere software reads them separately for each lane.
ivec3 cellOf(vec3 place, vec4 low, uvec4 many) {
  return ivec3(clamp((place - low.xyz) / low.w, vec3(0.0), vec3(many.xyz) - 1.0));
}
uint cellIndex(ivec3 cell, uvec4 many) { return uint(cell.x) + many.x * (uint(cell.y) + many.y * uint(cell.z)); }

#endif
