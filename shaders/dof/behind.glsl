// What behind.frag.glsl and its vertex shaders share: what the fragments need comes from the vertices, as each number of a
// uniform block costs every pixel.
#ifndef DOF_BEHIND_GLSL
#define DOF_BEHIND_GLSL

// Radius before the focus from which on what is behind it shows.
const float kNearStart = 1.0;

#endif
