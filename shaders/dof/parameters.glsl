// Of the passes that spread a field over its discs; both stages of a draw have the same block.
#ifndef DOF_PARAMETERS_GLSL
#define DOF_PARAMETERS_GLSL

layout(std140) uniform Parameters {
  int rings;    // of samples around the middle one, 5, 10, 15 ... in each, so that each stands for the same area; small discs take
                // fewer, large ones coarser levels
  int blades;   // of the aperture, for POLYGON
  int tile;     // texels of the fields along a tile's side
  float largest_far;  // radius of the sky's disc, texels of the fields
};

#endif
