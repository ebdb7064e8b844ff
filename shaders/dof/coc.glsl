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

// Discs below the first radius, in pixels of the full picture, are gathered from it (small/gather.comp.glsl), those above the second from
// the fields, in between a part by each.
const float kSmall = 3.0, kLarge = 4.0;

// Radius in texels of the fields up to which they have nothing to blur.
const float kLeastRadius = kSmall / float(SCALE);

// Twice the share of the far field that a texel in focus has.
const float kLeastShare = 2e-3;

// The share of the fields in a disc of a radius in pixels of the full picture.
float fieldShare(float radius) { return smoothstep(kSmall, kLarge, abs(radius)); }

// Discs whose radii differ by less than this, in pixels, are of one surface; the nearer one by twice as much lies wholly over the other.
vec4 gapAt(vec4 radius) { return 0.1 * abs(radius) + 0.2; }
float nearerBy(float own, float radius) { return clamp((own - radius) / gapAt(vec4(own)).x - 1.0, 0.0, 1.0); }

#endif
