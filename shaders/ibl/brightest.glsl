// The brightest spot of the environment, a sun or a lamp, which ibl/prefilter leaves out of the specular map: a light of its own.
// read   brightest?   `as uniform`, written by ibl/brightest.comp
#ifndef IBL_BRIGHTEST_GLSL
#define IBL_BRIGHTEST_GLSL

#include "common/equirect.glsl"

#ifdef HAS_BRIGHTEST
layout(std140) uniform brightest {
  vec4 brightest_at;     // towards it, in the map's own orientation; w: radiance above which it was cut out of the map
  vec4 brightest_light;  // irradiance that was cut out, on a surface facing it; w: its variance along one axis, radians squared
};
#else
const vec4 brightest_at = vec4(0.0, 1.0, 0.0, 65504.0), brightest_light = vec4(0.0);  // nothing is cut out
#endif

const float kWindow = 0.0873;       // radians around the spot that are cut: 5 degrees
const float kNearCosine = 0.98481;  // of twice as much

// A direction of the environment when it is rotated by `turn` of a full turn.
vec3 turnedAbout(vec3 at, float turn) {
  float c = cos(turn * 2.0 * kPi), s = sin(turn * 2.0 * kPi);
  return vec3(c * at.x - s * at.z, at.y, s * at.x + c * at.z);
}
vec3 towardsBrightest(float turn) { return turnedAbout(brightest_at.xyz, turn); }

// Its irradiance over pi on a surface that faces it; w: half the angle of its disc, radians. The same for all pixels.
vec4 spotIrradiance() { return vec4(brightest_light.rgb / kPi, max(2.0 * sqrt(brightest_light.w), 0.002)); }

// The spot's reflection in a GGX surface: the distribution of half vectors, a GGX tail with a bump on its peak.
struct SpotShape {
  float alpha2;    // squared width of the surface's own lobe
  float tail;      // squared width of the tail
  float bump;      // height of the bump
  float per_core;  // 1 / squared width of the bump
};

// For a spot with the variance `spread` along each axis of a half vector. The tail is GGX's own; what the spot's size takes from the peak
// is a rounder bump (1 + t / core)^-8, nearly a Gaussian. Both widths and the bump's share are such that a small spot changes nothing up to
// second order, and a mirror shows the spot.
SpotShape spotShape(float alpha, float spread) {
  float a2 = alpha * alpha, tail = a2 + 4.0 * spread, core = 7.0 * a2 + 12.0 * spread;
  return SpotShape(a2, tail, (1.0 - a2 / tail) * 7.0 / core, 1.0 / core);
}

// pi times its density at an angle whose sine has the square sine2 / h2, times `factor` / `below`.
float spotDistribution(SpotShape shape, float sine2, float h2, float factor, float below) {
  float d = sine2 * (1.0 - shape.tail) + h2 * shape.tail;
  float bump = h2 / (h2 + sine2 * shape.per_core), bump2 = bump * bump, bump4 = bump2 * bump2;
  return factor * (shape.alpha2 * h2 * h2 + shape.bump * bump4 * bump4 * d * d) / (d * d * below);
}

#endif
