// shading/ibl.glsl for the shaders of spheres, which have no parameters but its own.
#ifndef SPHERES_SHADING_GLSL
#define SPHERES_SHADING_GLSL

#ifdef HAS_SKY_TURN
layout(std140) uniform Parameters { float sky_turn; };
#endif

#include "shading/ibl.glsl"

#endif
