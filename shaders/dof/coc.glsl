// The circle of confusion of a thin lens. With focal length f, f-number N and focus distance s, a point at distance d is a disc
// of diameter f^2 / (N (s - f)) |1 - s / d| on the sensor; s / d is linear in reversed-Z depth, near / d, and 0 for the sky.
#ifndef DOF_COC_GLSL
#define DOF_COC_GLSL

#include "common/view.glsl"

// Radius in pixels of the full picture: positive in the far field, negative in the near field. `infinity` is that of the sky.
float cocRadius(float depth, float infinity, float focus, float largest) {
  return clamp(infinity * (1.0 - focus * depth / near_plane), -largest, largest);
}

// The reversed-Z depth at which the radius is `radius`, but at least that of the sky. A depth test against it skips pixels that are
// blurred less.
float cocDepth(float radius, float infinity, float focus) {
  return max(near_plane / focus * (1.0 - radius / max(infinity, 1e-6)), 0.0);
}

// defines SCALE  pixels of the picture along a texel of the fields: 2, the half size, or 1
#ifndef SCALE
#define SCALE 2
#endif

// Radius in texels of the fields up to which nothing is blurred.
const float kLeastRadius = 0.5 / float(SCALE);

// Twice the share of the far field that a texel in focus has.
const float kLeastShare = 2e-3;

// The weight of the blur for a radius in pixels of the full picture: below half a pixel the picture stays sharp.
float blurOf(float radius) { return smoothstep(0.5, 1.5, abs(radius)); }

// The weight of a picture from the fields beside the sharp one, for a radius in pixels of the full picture. Where fields have half its size,
// both together have the variance of the disc: fields and their filtering have that of a disc of nearly two pixels.
float sharedBlur(float radius) { return SCALE == 2 ? clamp(0.27 * radius * radius, 0.0, 1.0) : blurOf(radius); }

#endif
