// Parameters of the passes that blur a field over its discs, for both stages.
#ifndef DOF_PARAMETERS_GLSL
#define DOF_PARAMETERS_GLSL

layout(std140) uniform Parameters {
  int rings;    // of samples around the center, 5, 10, 15 ... in each, so that each covers the same area; small discs take
                // fewer, large ones coarser levels
  int blades;   // of the aperture, for POLYGON
  int tile;     // texels of the fields along a tile's side
  float largest_far;  // radius of the sky's disc, texels of the fields
};

#endif
