// How much of a lobe's width rays spread over; the rest is blur. 0: mirrors, which take one ray.
#ifndef REFLECTIONS_SPREAD_GLSL
#define REFLECTIONS_SPREAD_GLSL

float raySpread(float roughness) { return smoothstep(0.06, 0.16, roughness); }

// How much a pixel takes the mean with the rays of its neighbors: all of it before the spread shows as a pattern.
float sharesRays(float roughness) { return min(8.0 * raySpread(roughness), 1.0); }

#endif
