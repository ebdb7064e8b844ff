// A light far away whose shadows fall on the ground: the scene's sun, or the environment's brightest spot with SPOT.
// read    sun or brightest   see scene/sun.glsl, ibl/brightest.glsl
// params  sky_turn           rotation of the environment, in full turns
#ifndef GROUND_SHADOW_GLSL
#define GROUND_SHADOW_GLSL

#if SPOT
#include "ibl/brightest.glsl"
#else
#include "scene/sun.glsl"
#endif

layout(std140) uniform Parameters { float sky_turn; };

// Unit, towards the light; radians of half its disc. A disc of radius s has the variance s^2 / 4 along an axis.
vec4 lightAndAngle() {
#if SPOT
  return vec4(towardsBrightest(sky_turn), spotIrradiance().w);
#else
  return vec4(sun_light[0].direction, max(acos(clamp(sun_light[0].cos_angle, 0.0, 1.0)), 0.002));
#endif
}

#endif
