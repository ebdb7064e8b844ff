// Arc tangents of two angles at once.
#ifndef COMMON_FAST_ATAN_GLSL
#define COMMON_FAST_ATAN_GLSL

#include "common/equirect.glsl"

// atan(y, x) with an error below 1.1e-5 rad (a sixth of a percent of a texel of a 1024 map); x and y not both
// zero. Odd polynomial of degree 11 on [0, 1]: Hastings, "Approximations for Digital Computers", 1955, sheet 11.
vec2 fastAtan(vec2 y, vec2 x) {
  vec2 ax = abs(x), ay = abs(y);
  vec2 t = min(ax, ay) / max(max(ax, ay), 1e-30);
  vec2 s = t * t;
  vec2 r = ((((-0.01172120 * s + 0.05265332) * s - 0.11643287) * s + 0.19354346) * s - 0.33262347) * s + 0.99997726;
  r *= t;
  r = mix(r, 0.5 * kPi - r, greaterThan(ay, ax));
  r = mix(r, kPi - r, lessThan(x, vec2(0.0)));
  return mix(r, -r, lessThan(y, vec2(0.0)));
}

#endif
