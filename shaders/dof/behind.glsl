// What both stages of behind, and of near_behind, share.
#ifndef DOF_BEHIND_GLSL
#define DOF_BEHIND_GLSL

#include "coc.glsl"

layout(std140) uniform Parameters {
  float infinity;
  float focus;
  int largest;
#if NEAR
  int tile;
#endif
};

// Radius before the focus from which on what is behind it shows.
const float kNearStart = 1.0;

#endif
