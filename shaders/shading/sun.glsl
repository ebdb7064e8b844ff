// Light of the sun.
// read    sun    see scene/sun.glsl
//         sun_map?, sun_depth?   its shadow map, see shading/sun_shadow.glsl
// The includer has a directRadiance(): see shading/cook_torrance.glsl.
#ifndef SHADING_SUN_GLSL
#define SHADING_SUN_GLSL

#include "scene/sun.glsl"
#ifdef HAS_SUN_MAP
#include "shading/sun_shadow.glsl"
#endif

// `seen`: share of the sun that nothing hides but what is in the map.
vec3 sunRadiance(Point point, Response response, float seen) {
  Sun light = sun_light[0];
  if (dot(point.normal, light.direction) <= 0.0) return vec3(0.0);
#ifdef HAS_SUN_MAP
  seen *= seenInMap(shadowedSun(light), point.position, point.normal);
#endif
  return directRadiance(point, response, light.direction) * light.irradiance * seen;
}

#endif
