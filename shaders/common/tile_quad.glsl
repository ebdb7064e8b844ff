// For draws of "geometry": "quad" with one instance for each tile of the target, so that tiles without work cost nothing.
// Branches and discarding would not save that work on every device.
#ifndef COMMON_TILE_QUAD_GLSL
#define COMMON_TILE_QUAD_GLSL

#include "common/view.glsl"

ivec2 tileOf(ivec2 grid) { return ivec2(gl_InstanceID % grid.x, gl_InstanceID / grid.x); }

// This vertex of the tile `at`, whose side is `side` pixels long; the last tiles end at the border. When there is nothing to do,
// all four vertices are one point.
vec4 tileCorner(ivec2 at, ivec2 grid, int side, bool wanted) {
  ivec2 line = at + ivec2(gl_VertexID & 1, gl_VertexID >> 1);
  vec2 corner = mix(vec2(line * side) / viewport, vec2(1.0), equal(line, grid));
  return vec4(wanted ? corner * 2.0 - 1.0 : vec2(0.0), 0.0, 1.0);
}

#endif
