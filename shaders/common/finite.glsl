// Makes radiance fit for filters: a value that is not a number becomes 0, an infinite one the largest half, a negative one 0.
#ifndef COMMON_FINITE_GLSL
#define COMMON_FINITE_GLSL

vec3 finite(vec3 color) { return mix(vec3(0.0), min(color, vec3(65504.0)), greaterThanEqual(color, vec3(0.0))); }

#endif
