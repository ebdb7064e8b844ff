// Directions of the texels of equirectangular maps, for shaders that fill them; common/equirect.glsl is for lookups.
#ifndef COMMON_EQUIRECT_DIRECTION_GLSL
#define COMMON_EQUIRECT_DIRECTION_GLSL

#include "common/equirect.glsl"

// Unit direction of a point of the map.
vec3 equirectDirection(vec2 map_uv) {
  float phi = (map_uv.x - 0.5) * 2.0 * kPi;
  float theta = map_uv.y * kPi;
  return vec3(cos(phi) * sin(theta), cos(theta), sin(phi) * sin(theta));
}

#endif
