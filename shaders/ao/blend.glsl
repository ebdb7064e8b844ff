// Which neighbors of a surface point lie on the same surface, for filters of ambient occlusion.
#ifndef AO_BLEND_GLSL
#define AO_BLEND_GLSL

#include "surface.glsl"

struct Surface {
  vec3 place, plane;  // the tangent plane over its thickness, in view space
};

// A hundredth of the radius thick, and the width of two pixels there; distances are stored as halves.
Surface surfaceAt(ivec2 pixel, float z, float radius) {
  vec3 place = placeAt(pixel, z);
  return Surface(place, facing(pixel) / (0.01 * radius - place.z * (2.0 / focalPixels().y + 1e-3)));
}

// Weight of a neighbor by its distance from the tangent plane; `pixel` is the neighbor's in the depth.
float onSurface(Surface surface, ivec2 pixel, float neighbor_distance) {
  if (neighbor_distance <= 0.0) return 0.0;
  float off = dot(axisRay(vec2(pixel) + 0.5) * neighbor_distance - surface.place, surface.plane);
  return max(1.0 - off * off, 0.0);
}

#endif
