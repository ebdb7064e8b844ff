// Which neighbors of a surface point lie on the same surface and look the same way, for filters of ambient occlusion.
#ifndef AO_BLEND_GLSL
#define AO_BLEND_GLSL

#include "surface.glsl"

struct Surface {
  vec3 place, plane;  // in view space; the normal over the thickness of the tangent plane
  vec3 normal;        // in the world
};

// A hundredth of the radius thick, and the width of two pixels there; distances are stored as halves.
Surface surfaceAt(ivec2 pixel, float z, float radius) {
  vec3 place = placeAt(pixel, z), n = worldNormal(pixel);
  return Surface(place, mat3(view) * n / (0.01 * radius - place.z * (2.0 / focalPixels().y + 1e-3)), n);
}

// Weight of a neighbor by its distance from the tangent plane, and by its normal. One that looks elsewhere counts a little: the mean over
// too few directions is worse. `pixel` is the neighbor's in the depth.
float onSurface(Surface surface, ivec2 pixel, float neighbor_distance) {
  if (neighbor_distance <= 0.0) return 0.0;
  float off = dot(axisRay(vec2(pixel) + 0.5) * neighbor_distance - surface.place, surface.plane);
  float alike = max(dot(worldNormal(pixel), surface.normal), 0.0);
  for (int i = 0; i < 5; ++i) alike *= alike;
  return max(1.0 - off * off, 0.0) * mix(0.05, 1.0, alike);
}

#endif
