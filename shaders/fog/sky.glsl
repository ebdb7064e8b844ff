// Fog in front of the sky; slots as in fog.glsl.
#ifndef FOG_SKY_GLSL
#define FOG_SKY_GLSL

#include "fog.glsl"

#ifdef HAS_AIR
// Transmittance towards the sky, in a direction whose component along the view axis is 1. The sky has no distance, so the fog in front of
// it is a layer that ends above and below the eye and is thickest at the horizon.
float throughFogOfSky(vec3 direction) {
  return mix(1.0, throughFog(direction * min(fog_shape.y / max(abs(direction.y), 1e-12), 1e6)), fog_shape.z);
}
#endif

#endif
