// Which neighbors of a surface point lie on the same surface, for filters of ambient occlusion.
#ifndef AO_BLEND_GLSL
#define AO_BLEND_GLSL

#include "surface.glsl"

// Weight of a neighbor by its distance from the tangent plane, 0 at `thickness`; `pixel` is the neighbor's in the depth.
float onPlane(vec3 place, vec3 n, float thickness, ivec2 pixel, float neighbor_distance) {
  if (neighbor_distance <= 0.0) return 0.0;
  vec3 other = axisRay(vec2(pixel) + 0.5) * neighbor_distance;
  float off = abs(dot(other - place, n)) / thickness;
  return max(1.0 - off * off, 0.0);
}

// A tenth of the radius, and the width of four pixels there; distances are stored as halves.
float thicknessAt(float radius, float view_distance) {
  return 0.1 * radius + view_distance * (4.0 / focalPixels().y + 1e-3);
}

#endif
