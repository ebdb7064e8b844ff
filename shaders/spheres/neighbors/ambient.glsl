// Light of the environment on a sphere among others: what they hide of it, and the light that they and the ground
// reflect in its place. In place of ambientOf() of shading/ambient.glsl.
// read    neighbors   see spheres/neighbors/listed.glsl
//         irradiance_above?   `as linear wrap`: the irradiance map of what is above the horizon, with a ground
#ifndef SPHERES_NEIGHBORS_AMBIENT_GLSL
#define SPHERES_NEIGHBORS_AMBIENT_GLSL

#include "shading/ambient.glsl"
#include "spheres/lobe_varyings.glsl"
#include "spheres/neighbors/irradiance.glsl"
#ifdef HAS_SPECULAR
#include "spheres/neighbors/occluder_light.glsl"
#endif

#ifdef HAS_IRRADIANCE_ABOVE
uniform sampler2D irradiance_above;
#endif

// `radius`: of the sphere that has the point.
Ambient ambientAmongSpheres(Occlusion occlusion, Point point, Surface surface, Response response, Lobe lobe,
                            LightsSeen seen, float radius) {
  Ambient ambient = noAmbient();
  GroundPlane plane = occlusion.plane;
  LobeGround ground = occlusion.ground;
  GroundLight ground_light = groundLight(lobe, sky_above.rgb);
  float surface_below = surfaceOf(plane, point.position);
#ifdef HAS_SPECULAR
  vec3 axis = overGround(lobeAxis(point, response), occlusion.lobe.width, ground.surface);
  vec3 sky = reflectedEnvironment(point, response, lobe, axis);
  vec3 below = groundRadiance(plane, ground_light, sky, ground.surface, ground.hidden, ground.lights);
  vec3 occluders = occluderRadiance(occlusion, point, surface, radius, lobe, ground_light);
  vec3 behind = mix(sky, below, ground.share);
#if SEES_SCENE
  vec4 scene = max(seenOfScene(point, response), vec4(0.0));
  behind = behind * (1.0 - scene.a) + scene.rgb;
#endif
  ambient.reflected = (behind * occlusion.lobe.seen + occluders) * response.single;
#ifdef HAS_BRIGHTEST
  ambient.reflected += reflectedSpot(point, response, lobe, spotStrength(point, lobe) * seen.spot);
#endif
#endif
#ifdef HAS_IRRADIANCE
  vec3 bent = occlusion.sky.bent;
  vec4 mean = irradianceTowards(bent, lobe);
  vec3 open_ground = mix(sky_below.rgb, plane.albedo * totalOf(ground_light), surface_below);
#ifdef HAS_IRRADIANCE_ABOVE
  vec4 above = sampleEquirect(irradiance_above, equirectUv(bent) - vec2(sky_turn, 0.0), vec2(0.0, lobe.irradiance_pole));
  mean = mix(mean, vec4(above.rgb + open_ground * (0.5 - 0.5 * bent.y), above.a), surface_below);
#endif
  ambient.mean = irradianceSeen(occlusion.sky, point.normal, lobe, mean, seen.spot, open_ground);
#ifdef HAS_PROBES
  ambient.mean += bouncedIrradiance(point, lobe);
#endif
#endif
  return ambient;
}

#endif
