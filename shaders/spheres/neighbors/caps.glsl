// A sphere as seen from a point is a cap of the directions around that point. Closed forms of what caps hide.
#ifndef SPHERES_NEIGHBORS_CAPS_GLSL
#define SPHERES_NEIGHBORS_CAPS_GLSL

#include "common/fast_atan.glsl"

// acos with an error below 7e-5 (Abramowitz and Stegun, "Handbook of Mathematical Functions", 1964, 4.4.45).
float arcCosine(float x) {
  float a = min(abs(x), 1.0);
  float angle = sqrt(1.0 - a) * (((-0.0187293 * a + 0.0742610) * a - 0.2121144) * a + 1.5707288);
  return x < 0.0 ? kPi - angle : angle;
}

// The share of a uniform sky's light on a surface that a sphere hides: the integral of the cosine over the part of its
// cap above the surface's horizon, over pi. `ratio` is distance / radius, at least 1; `facing` is the cosine between
// the normal and the direction to its center. Exact: Snyder, "Area Light Sources for Real-Time Graphics", MSR-TR-96-11,
// 1996; as Lagarde and de Rousiers write it, "Moving Frostbite to Physically Based Rendering", SIGGRAPH 2014, 4.7.2.
float capShare(float ratio, float facing) {
  float r2 = ratio * ratio, height = ratio * facing;
  if (height >= 1.0) return facing / r2;
  if (height <= -1.0) return 0.0;
  float tangent = sqrt(max(r2 - 1.0, 1e-12)), rim = sqrt(max(1.0 - height * height, 0.0));
  float slant = sqrt(max(1.0 - facing * facing, 1e-12));
  float above = facing * arcCosine(clamp(-facing * tangent / slant, -1.0, 1.0)) - rim * tangent;
  return max((above / r2 + fastAtan(vec2(rim), vec2(tangent)).x) / kPi, 0.0);
}

// The share of a disc of radius `wide` around a ray that a sphere of radius `over` covers: a smooth step between
// touching and covering (Oat and Sander, "Ambient aperture lighting", I3D 2007). The sphere's center is `along` the ray
// and `beside` it, at the distance `away` from its start.
float discShare(float over, float wide, float along, float beside, float away) {
  beside = along > 0.0 ? beside : away - along;
  float least = min(over, wide), x = clamp((over + wide - beside) / (2.0 * least), 0.0, 1.0), size = least / wide;
  return size * size * x * x * (3.0 - 2.0 * x);
}

// Weight of a sphere whose center is `ratio` radii away: 1 near it, 0 from `reach` radii on.
float withinReach(float ratio, float reach) { return 1.0 - smoothstep(0.75 * reach, reach, ratio); }

#endif
