// Radiance that filters can take: what is not a number becomes black, what is infinite the largest half, what is negative 0.
#ifndef COMMON_FINITE_GLSL
#define COMMON_FINITE_GLSL

vec3 finite(vec3 color) { return mix(vec3(0.0), min(color, vec3(65504.0)), greaterThanEqual(color, vec3(0.0))); }

#endif
