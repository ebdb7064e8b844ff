// How much of a lobe's width rays spread over; the rest is blur. 0: mirrors, which take one ray. Rays of narrow lobes would be dots where
// they meet a glint.
#ifndef REFLECTIONS_SPREAD_GLSL
#define REFLECTIONS_SPREAD_GLSL

float raySpread(float roughness) { return smoothstep(0.1, 0.2, roughness); }

// How much neighbors share their rays, and rays of a lobe's tail look wider: all of it before they are far apart.
float sharedOf(float spread) { return min(4.0 * spread, 1.0); }

#endif
