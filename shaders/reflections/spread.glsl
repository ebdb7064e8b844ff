// How much of a lobe's width rays spread over; the rest is blur. 0: mirrors, which take one ray.
#ifndef REFLECTIONS_SPREAD_GLSL
#define REFLECTIONS_SPREAD_GLSL

float raySpread(float roughness) { return smoothstep(0.06, 0.16, roughness); }

#endif
