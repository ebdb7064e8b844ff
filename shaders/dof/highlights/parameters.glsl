// Slot and parameters of the draw of highlights, for both stages.
#ifndef DOF_HIGHLIGHTS_PARAMETERS_GLSL
#define DOF_HIGHLIGHTS_PARAMETERS_GLSL

#include "list.glsl"

layout(std430) readonly buffer highlights { TileHighlights lists[]; };
layout(std140) uniform Parameters {
  float infinity;  // as in split
  float focus;     // likewise
  int tile;        // texels of the fields along a tile's side
  int blades;      // of the aperture, for POLYGON
  ivec2 grid;      // how many tiles there are along x and y
};

#endif
