// Spheres sorted by the cells of a grid over the box of their centres, so that those near a place are found without a look at all.
// Cells are cubes. A sphere stands in the cell of its centre; spheres over twice the usual radius (the geometric mean) stand in one more
// cell, the last, which everybody looks through.
// grid   buffer; the define GRID_ACCESS is its qualifier, readonly by default
#ifndef NEIGHBOURS_GRID_GLSL
#define NEIGHBOURS_GRID_GLSL

#ifndef GRID_ACCESS
#define GRID_ACCESS readonly
#endif

layout(std430) GRID_ACCESS buffer grid {
  vec4 grid_low;     // xyz: least corner; w: side of a cell
  uvec4 grid_cells;  // along x, y and z; w: of all these
  vec4 grid_radii;   // x: greatest of those that are not large; y: from which on one is large
  uint grid_word[];  // for each cell, and for the last: where its rows end; then, from `cells` + 1 on, rows of spheres by cell
};

// `low` and `many` are grid_low and grid_cells, which a shader reads once, outside of loops and before any return: elsewhere software reads
// them for each lane by itself.
ivec3 cellOf(vec3 place, vec4 low, uvec4 many) { return ivec3(clamp((place - low.xyz) / low.w, vec3(0.0), vec3(many.xyz) - 1.0)); }
uint cellIndex(ivec3 cell, uvec4 many) { return uint(cell.x) + many.x * (uint(cell.y) + many.y * uint(cell.z)); }

#endif
