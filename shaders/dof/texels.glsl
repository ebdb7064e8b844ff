// Discs so small that each texel in them is a sample.
#ifndef DOF_TEXELS_GLSL
#define DOF_TEXELS_GLSL

#include "coc.glsl"

// A disc that samples each texel. One of hardly more than a texel weighs the eight around it by its variance, four times as much along the
// axes as along the diagonals: by areas it would be a cross. Computed once for all samples, because each division would cost in every one.
struct Texels {
  float radius;
  float large;   // 0: weights by variance; 1: by areas
  float beside;  // weight of each texel beside the center, whose weight is 1, where it is not large
  float sum;     // of all texels
};
Texels texelsOf(float radius) {
  float square = min(radius * radius, 1.21), part = 1.0 / (12.0 - 5.0 * square);
  Texels texels = Texels(radius, clamp(5.0 * radius - 4.5, 0.0, 1.0), square * part, 0.0);
  texels.sum = mix(12.0 * part, 3.14159265 * (radius * radius + 1.0 / 12.0), texels.large);
  return texels;
}

// The share of a texel at the distance `across` that a disc covers.
float texelWithin(Texels texels, float across) {
  float small = across < 0.5 ? 1.0 : texels.beside * (across < 1.2 ? 1.0 : across < 1.6 ? 0.25 : 0.0);
  return mix(small, clamp(texels.radius - across + 0.5, 0.0, 1.0), texels.large);
}

#if POLYGON
// Behind the focus a disc has the aperture's outline, in front of it the same upside down, because there the rays have not yet crossed. A
// pixel in the upper part of a disc finds its light below.
const float kUpright = NEAR == 1 ? 1.0 : -1.0;

// Radius of the polygon of the blades in this direction, relative to that of its corners.
float outline(vec2 direction, int blades) {
  float sector = 6.28318530717959 / float(blades), angle = atan(direction.y, direction.x);
  return cos(sector * 0.5) / cos(mod(angle, sector) - sector * 0.5);
}
#endif

// Radius of a round disc that has the area of the aperture's outline, of the radius of its corners.
float roundnessOf(int blades) {
#if POLYGON
  float sector = 6.28318530717959 / float(blades);
  return sqrt(sin(sector) / sector);
#else
  return 1.0;
#endif
}

// The distance of a texel from the middle of a disc, as if the aperture were round.
float acrossOf(vec2 offset, float roundness, int blades) {
  float across = length(offset);
#if POLYGON
  // A texel is as wide as a part of the outline, near the middle of all of it.
  across *= mix(1.0, roundness / outline(kUpright * offset, blades), smoothstep(1.0, 3.0, across));
#endif
  return across;
}

// The radius at which a round disc ends in the samples, less what filtering adds.
float reachInTexels(float radius) {
  return sqrt(max(radius * radius - (SCALE == 2 ? clamp(0.85 * radius - 0.275, 0.75, 1.0) : 0.0), 1e-4));
}

// Texels to either side whose middles are nearer than `span`.
int texelsWithin(float span) { return int(ceil(span)) - 1; }

#endif
