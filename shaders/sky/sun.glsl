// The computed sky around its sun as it is seen: with a disc instead of the lobe that lights the scene.
// params  elevation, azimuth, turbidity   see daylight.comp.glsl
#ifndef SKY_SUN_GLSL
#define SKY_SUN_GLSL

#include "daylight.glsl"

const float kAround = 0.15;  // radians; the lobe ends there

// In the unit direction `at`, where the map has `color`; a pixel is `pixel` radians wide.
vec3 withSun(Daylight day, vec3 color, vec3 at, float pixel) {
  // Limb darkening 1 - u (1 - cos), with the mean 1 - u / 3. A disc smaller than a pixel is one of a pixel, and as much darker.
  const float radius = radians(0.2665);
  const vec3 u = vec3(0.5, 0.6, 0.75);
  float gamma = distance(at, day.to_sun);
  float seen = max(radius, 0.6 * pixel), inside = max(1.0 - gamma * gamma / (seen * seen), 0.0);
  vec3 disc = day.sun_light / (kPi * seen * seen) * (1.0 - u * (1.0 - sqrt(inside))) / (1.0 - u / 3.0);
  vec3 sky = radianceOf(day, at, gamma, 1.0 - 0.5 * gamma * gamma);
  sky += disc * clamp((seen - gamma) / pixel + 0.5, 0.0, 1.0);
  return mix(min(sky, vec3(60000.0)), color, smoothstep(kAround - 0.02, kAround, gamma));
}

#endif
