// Makes radiance safe to filter: NaN becomes 0, infinity the largest half float, negative values 0.
#ifndef COMMON_FINITE_GLSL
#define COMMON_FINITE_GLSL

vec3 finite(vec3 color) { return mix(vec3(0.0), min(color, vec3(65504.0)), greaterThanEqual(color, vec3(0.0))); }

#endif
