// How much of a lobe's width rays spread over; the rest is blur. 0: mirrors, which take one ray. Rays of narrow lobes would be dots where
// they meet a glint.
#ifndef REFLECTIONS_SPREAD_GLSL
#define REFLECTIONS_SPREAD_GLSL

float raySpread(float roughness) { return smoothstep(0.1, 0.2, roughness); }

// How much a pixel takes the mean of its neighbors' rays, and how much wider rays of the lobe's tail look than others: wholly before rays are
// far apart.
float sharedOf(float spread) { return min(4.0 * spread, 1.0); }

#endif
