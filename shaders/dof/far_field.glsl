// Shared by far_field.frag.glsl and its vertex shaders, which pass uniforms on as varyings: in software a read of a uniform block costs
// time in every pixel.
#ifndef DOF_FAR_FIELD_GLSL
#define DOF_FAR_FIELD_GLSL

#include "dof/coc.glsl"

// Radius in the near field from which the far field is visible beside it.
const float kNearStart = kSmall;
float nearShown(float radius) { return smoothstep(kNearStart, kLarge, -radius); }

#endif
