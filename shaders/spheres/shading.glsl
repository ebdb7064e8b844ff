// What surfaces that are drawn forward do with light: Cook-Torrance. For shading/light.glsl, which this includes.
#ifndef SPHERES_SHADING_GLSL
#define SPHERES_SHADING_GLSL

#include "shading/light.glsl"

void finishResponse(inout Response response) {}

vec3 throwAround(Point point, Response response, vec3 reflected, vec3 around) {
  return reflected + (response.multiple + response.diffuse) * around;
}

vec3 throwFrom(Point point, Response response, vec3 l) {
  return cookTorrance(response, point.surface.roughness, point.n, point.v, l);
}

#endif
