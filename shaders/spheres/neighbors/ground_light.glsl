// The ground as spheres see it: what light it gets, and what it reflects.
#ifndef SPHERES_NEIGHBORS_GROUND_LIGHT_GLSL
#define SPHERES_NEIGHBORS_GROUND_LIGHT_GLSL

#include "spheres/neighbors/occlusion.glsl"

// Irradiance over pi of the ground where nothing stands.
struct GroundLight {
  vec3 sky, spot, sun;  // of spots the first; the others count as sky, see ambientAmongSpheres()
};

// `up` is the irradiance map's value straight up.
GroundLight groundLight(Lobe lobe, vec3 up) {
  GroundLight light = GroundLight(up, vec3(0.0), vec3(0.0));
#ifdef HAS_BRIGHTEST
  light.spot = min(spotIrradiance(0).rgb * max(lobe.spot.y, 0.0), up);
  light.sky -= light.spot;
#endif
#ifdef HAS_SUN
  light.sun = sun_light[0].irradiance * (max(sun_light[0].direction.y, 0.0) / kPi);
#endif
  return light;
}

vec3 totalOf(GroundLight light) { return light.sky + light.spot + light.sun; }

// The share of the sky's light on the ground that spheres leave, with what they reflect: see
// spheres/ground/contact.frag.glsl. `hidden` as in LobeGround.
vec3 skyOnGround(GroundPlane plane, vec4 hidden) {
  float share = min(hidden.a, 0.999);  // of white things, all hidden is 0 / 0
  vec3 reflected = min(hidden.rgb, vec3(share));
  return (1.0 - share) * (1.0 + reflected) / (1.0 - share * reflected * plane.albedo);
}

// Radiance of the ground: `surface` is the share of its surface in it; the rest is the environment, darkened as the
// surface is.
vec3 groundRadiance(GroundPlane plane, GroundLight light, vec3 environment, float surface, vec4 hidden,
                    LightsSeen seen) {
  const vec3 kLuminance = vec3(0.2126, 0.7152, 0.0722);
  vec3 all = totalOf(light);
  vec3 arrives = light.sky * skyOnGround(plane, hidden) + light.spot * seen.spot + light.sun * seen.sun;
  float left = min(dot(arrives, kLuminance) / max(dot(all, kLuminance), 1e-6), 1.0);
  return mix(environment * left, plane.albedo * arrives, surface);
}

// Least height of an axis above the ground, in widths of the cone: fitted to path-traced pictures.
const float kOverGround = 0.7;

// A lobe's axis, lifted so far that its cone sees what is above the ground.
vec3 overGround(vec3 axis, float width, float surface) {
  axis.y = mix(axis.y, max(axis.y, kOverGround * width), surface);
  return axis;
}

#endif
