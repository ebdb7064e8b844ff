// Radiance that leaves a surface towards the eye: of the environment, the sun and lamps. Include a shading model before, such as
// shading/cook_torrance.glsl; it says what the surface does with light, as ambientRadiance() and directRadiance().
// read    brdf     see shading/material.glsl
//         irradiance?, spot_cosines?, specular?, environment?, brightest?, probes?, sh?   see shading/ambient.glsl
//         sun?                                                             see shading/sun.glsl
//         lamps?, lamp_maps?, clusters?, slices?                           see shading/lamps.glsl
//         light_maps?, light_depths?, scene_bounds?   shadows that meshes cast, see shading/mesh_shadow.glsl
// params  sky_turn?, lamp_count   see shading/parameters.glsl
// A variant without sun and lamps has no code for them.
#ifndef SHADING_LIGHT_GLSL
#define SHADING_LIGHT_GLSL

#include "shading/parameters.glsl"
#include "shading/ambient.glsl"
#ifdef HAS_SUN
#include "shading/sun.glsl"
#endif
#ifdef HAS_LAMPS
#include "shading/lamps.glsl"
#endif

#if defined HAS_LIGHT_MAPS && defined HAS_LIGHT_DEPTHS && defined HAS_SCENE_BOUNDS
#include "shading/mesh_shadow.glsl"
LightsSeen lightsSeen(Point point) { return lightsPastMeshes(point.position, point.normal, sky_turn); }
#else
LightsSeen lightsSeen(Point point) { return kOpen; }
#endif

struct Light {
  vec3 radiance;
  int lamps_tried;  // how many lamps the pixel went through
};

Light lightOf(Point point, Response response, Ambient ambient, LightsSeen seen) {
  Light light = Light(ambientRadiance(point, response, ambient), 0);
#ifdef HAS_SUN
  light.radiance += sunRadiance(point, response, seen.sun);
#endif
#ifdef HAS_LAMPS
  light.radiance += lampsRadiance(point, response, light.lamps_tried);
#endif
  return light;
}

#endif
