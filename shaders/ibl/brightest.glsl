// The brightest spots of the environment, a sun, lamps or windows, which ibl/prefilter leaves out of the specular map: lights of their own.
// read   brightest?   `as uniform`, written by ibl/brightest.comp
#ifndef IBL_BRIGHTEST_GLSL
#define IBL_BRIGHTEST_GLSL

#include "common/equirect.glsl"
#include "ibl/spot.glsl"

#ifdef HAS_BRIGHTEST
layout(std140) uniform brightest {
  Spot spots[kSpots];
  int spot_count;
  float sun_radius;  // half the angle of the first one's disc where that is known, radians, else 0
};
#else
const float sun_radius = 0.0;
const Spot spots[kSpots] = Spot[](kNoSpot, kNoSpot, kNoSpot, kNoSpot);
const int spot_count = 0;
#endif

// A direction of the environment when it is rotated by `turn` of a full turn.
vec3 turnedAbout(vec3 at, float turn) {
  float c = cos(turn * 2.0 * kPi), s = sin(turn * 2.0 * kPi);
  return vec3(c * at.x - s * at.z, at.y, s * at.x + c * at.z);
}
vec3 towardsSpot(int i, float turn) { return turnedAbout(spots[i].at.xyz, turn); }

// A spot's irradiance over pi on a surface that faces it; w: half the angle of its disc, radians. The same for all pixels.
vec4 spotIrradiance(int i) {
  return vec4(spots[i].light.rgb / kPi, i == 0 && sun_radius > 0.0 ? sun_radius : max(2.0 * sqrt(spots[i].light.w), 0.002));
}

// The part of a shadow map that spot `i` has: its corner and its size. The first has a map of its own; the others share one, a quarter each,
// with room around it for penumbrae.
vec3 partOfSpot(int i) { return i > 0 ? vec3(0.5 * vec2(i & 1, i >> 1) + 0.05, 0.4) : vec3(0.0, 0.0, 1.0); }

// 1 for spot `i` alone.
vec4 onlySpot(int i) { return vec4(equal(ivec4(0, 1, 2, 3), ivec4(i))); }

// What each spot gives to a surface that faces up, of irradiance over pi.
vec3 spotFromAbove(int i) { return spots[i].light.rgb * (max(spots[i].at.y, 0.0) / kPi); }
mat4x3 spotsFromAbove() { return mat4x3(spotFromAbove(0), spotFromAbove(1), spotFromAbove(2), spotFromAbove(3)); }

// A spot's reflection in a GGX surface: the distribution of half vectors, a GGX tail with a bump on its peak.
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
