// Light that leaves a sphere towards the eye: as of other surfaces, and a glint of the brightest spot in small ones.
// read    neighbors?    what spheres hide of each other, see spheres/neighbors/ambient.glsl
//         the lights: shading/light.glsl
#ifndef SPHERES_LIGHT_GLSL
#define SPHERES_LIGHT_GLSL

#include "shading/cook_torrance.glsl"
#include "shading/light.glsl"
#ifdef HAS_NEIGHBORS
#include "spheres/neighbors/ambient.glsl"
#endif

// `glint`: see glintStrength(). `row` and `radius` are the sphere's.
Light sphereLight(Point point, Surface surface, Lobe lobe, float glint, uint row, float radius) {
  Response response = responseOf(surface, point.nv);
  LightsSeen seen = lightsSeen(point);
#ifdef HAS_NEIGHBORS
  NeighborList list = listOf(row);
  Occlusion occlusion = occlusionOf(list, point, surface, lobeAxis(point, response), lobe);
  // The shadow maps may contain spheres too.
  seen.sun = min(seen.sun, occlusion.lights.sun);
  seen.spot = min(seen.spot, occlusion.lights.spot);
  if (lobe.spot.y < 0.0) seen.spot *= 1.0 - surfaceOf(occlusion.plane, point.position);  // the ground hides it
  Ambient ambient = ambientAmongSpheres(list, occlusion, point, surface, response, lobe, seen, radius);
#else
  Ambient ambient = ambientOf(point, response, lobe, seen);
#endif
#if defined HAS_SPECULAR && defined HAS_BRIGHTEST
  ambient.reflected += reflectedSpot(point, response, lobe, glint * seen.spot);
#endif
  return lightOf(point, response, ambient, seen);
}

#endif
