// The shading model of what is drawn forward: Cook-Torrance. Include it before shading/light.glsl.
#ifndef SHADING_COOK_TORRANCE_GLSL
#define SHADING_COOK_TORRANCE_GLSL

#include "shading/brdf.glsl"
#include "shading/point.glsl"
#ifdef HAS_MATERIAL_LAYERS
#include "shading/layers.glsl"
#endif

// Radiance towards the eye of the environment's light.
vec3 ambientRadiance(Point point, Response response, Ambient ambient) {
#ifdef HAS_MATERIAL_LAYERS
  if (layers.on) return layeredAmbient(point, response, ambient);
#endif
#if SEES_SCENE
  return ambientWithScene(ambient, response.multiple, response.diffuse, point.sky_visible, point.sky_visible);
#else
  return (ambient.reflected + (response.multiple + response.diffuse) * ambient.mean) * point.sky_visible;
#endif
}

// Radiance towards the eye for an irradiance of 1 from the unit direction `l`.
vec3 directRadiance(Point point, Response response, vec3 l) {
#ifdef HAS_MATERIAL_LAYERS
  if (layers.on) return layeredDirect(point, response, l);
#endif
  return cookTorrance(response, point.normal, point.to_eye, l);
}

#endif
