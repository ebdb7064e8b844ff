// The overlap of caps of directions, and of discs in the sky.
#ifndef NEIGHBORS_OVERLAP_GLSL
#define NEIGHBORS_OVERLAP_GLSL

#include "common/equirect.glsl"

// The share of a cap of half angle `wide` that a cap of half angle `over` covers. Their axes are `apart`; all are in
// radians. It is a smooth step between touching and covering (Oat and Sander, "Ambient aperture lighting", I3D 2007).
float capOverlap(float over, float wide, float apart) {
  float least = min(over, wide), size = sin(0.5 * least) / sin(0.5 * wide);
  float x = clamp((over + wide - apart) / (2.0 * least), 0.0, 1.0);
  return size * size * x * x * (3.0 - 2.0 * x);
}

// The share of a disc of radius `wide` that a disc of radius `over` covers. Their centers are `apart`. It is the
// intersection of two flat circles, right for small angles.
float discOverlap(float over, float wide, float apart) {
  if (apart >= over + wide) return 0.0;
  float least = min(over, wide);
  if (apart <= abs(over - wide)) return least * least / (wide * wide);
  float o2 = over * over, w2 = wide * wide, beyond = (apart - over) * (apart + over);
  float kite = sqrt(max((over + wide - apart) * (apart + over - wide) * (apart + wide - over) * (over + wide + apart), 0.0));
  // Not by the arc cosine: of a small disc before a large one it has no digits left.
  return (o2 * atan(kite, apart * apart + o2 - w2) + w2 * atan(kite, beyond + w2) - 0.5 * kite) / (kPi * w2);
}

#endif
