// Shared by far_field.frag.glsl and its vertex shaders. The vertex shaders pass on what fragments need, because each number that
// fragments read from a uniform block costs time in every pixel.
#ifndef DOF_FAR_FIELD_GLSL
#define DOF_FAR_FIELD_GLSL

// Radius in the near field from which on the far field shows beside it.
const float kNearStart = 1.0;

#endif
