// Light of the sun.
// read    sun    see scene/sun.glsl
// The includer has a directRadiance(): see shading/cook_torrance.glsl.
#ifndef SHADING_SUN_GLSL
#define SHADING_SUN_GLSL

#include "scene/sun.glsl"

// `seen`: share of the sun that nothing hides.
vec3 sunRadiance(Point point, Response response, float seen) {
  Sun light = sun_light[0];
  if (dot(point.normal, light.direction) <= 0.0) return vec3(0.0);
  light_radius = sqrt(max(1.0 - light.cos_angle * light.cos_angle, 0.0));
  vec3 radiance = directRadiance(point, response, light.direction);
  light_radius = 0.0;
  return radiance * light.irradiance * seen;
}

#endif
