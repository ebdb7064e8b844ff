// Lights far away whose shadows fall on the ground: the scene's sun, or the environment's brightest spots with SPOTS.
// read    sun or brightest   see scene/sun.glsl, ibl/brightest.glsl
// params  sky_turn           rotation of the environment, in full turns
#ifndef GROUND_SHADOW_GLSL
#define GROUND_SHADOW_GLSL

#if SPOTS
#include "ibl/brightest.glsl"
#else
#include "scene/sun.glsl"
#endif

layout(std140) uniform Parameters { float sky_turn; };

// Unit, towards the light, or down where there is no such spot; radians of half its disc. A disc of radius s has the variance s^2 / 4
// along an axis.
vec4 lightAndAngle(int spot) {
#if SPOTS
  return spot < spot_count ? vec4(towardsSpot(spot, sky_turn), spotIrradiance(spot).w) : vec4(0.0, -1.0, 0.0, 0.0);
#else
  return vec4(sun_light[0].direction, max(acos(clamp(sun_light[0].cos_angle, 0.0, 1.0)), 0.002));
#endif
}

#endif
