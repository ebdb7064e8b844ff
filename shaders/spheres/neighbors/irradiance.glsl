// Irradiance of a point of a sphere among others.
#ifndef SPHERES_NEIGHBORS_IRRADIANCE_GLSL
#define SPHERES_NEIGHBORS_IRRADIANCE_GLSL

#include "spheres/neighbors/ground_light.glsl"

// The share of the sky's light that arrives, with what comes back from what hides the rest. That is lit as this point
// is, so that light bounces between them: a geometric series (Stewart and Langer, "Towards accurate recovery of shape from
// shading under diffuse lighting", PAMI 1997).
vec3 skyArrives(SkyOcclusion occlusion) {
  vec3 seen = vec3(occlusion.seen);
#ifndef HAS_PROBES
  seen /= 1.0 - occlusion.albedo * (1.0 - seen);  // with probes, these give the light that comes back
#endif
  return seen;
}

// Over pi. `mean` is the irradiance map in the bent direction, with its alpha; `spot_seen` the visible share of the
// spot; `ground` what the ground below reflects.
vec3 irradianceSeen(SkyOcclusion occlusion, vec3 n, Lobe lobe, vec4 mean, float spot_seen, vec3 ground) {
  vec3 sky = mean.rgb;
#ifdef HAS_BRIGHTEST
  vec3 spot = spotIrradiance(0).rgb;
  sky = max(sky - spot * mean.a, vec3(0.0));
#endif
  vec3 light = sky * skyArrives(occlusion);
#ifdef HAS_BRIGHTEST
  light += spot * (max(dot(n, lobe.spot), 0.0) * spot_seen);
#endif
  return max(light - ground * occlusion.contact, vec3(0.0));
}

#endif
