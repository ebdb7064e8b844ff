// What far_field.frag.glsl and its vertex shaders share: what the fragments need comes from the vertices, as each number of a
// uniform block costs every pixel.
#ifndef DOF_FAR_FIELD_GLSL
#define DOF_FAR_FIELD_GLSL

// Radius in the near field from which on the far field shows beside it.
const float kNearStart = 1.0;

#endif
