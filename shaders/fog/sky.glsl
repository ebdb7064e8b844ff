// Fog in front of the sky; slots as in fog.glsl.
#ifndef FOG_SKY_GLSL
#define FOG_SKY_GLSL

#include "fog.glsl"

#ifdef HAS_AIR
// Transmittance towards the sky, for a lobe of GGX's `alpha` around a direction, from a place of that `height`. The sky has no distance, so
// the fog in front of it is a layer that ends above and below, where not above the ground, and is thickest at the horizon. A lobe sees it at
// its mean height: 0.05 off the integral over the lobe in the mean.
float throughFogOfSky(vec3 direction, float height, float alpha) {
  float y2 = direction.y * direction.y / dot(direction, direction), y = sqrt(mix(0.25 * alpha * alpha, 1.0, y2));
  float layer = direction.y < 0.0 ? max(fog_shape.y, height - fog_light.w) : fog_shape.y, far = min(layer / max(y, 1e-12), 1e6);
  return mix(1.0, throughFog(height, direction.y < 0.0 ? -y * far : y * far, far), fog_shape.z);
}

float throughFogOfSky(vec3 direction) { return throughFogOfSky(direction, eye.y, 0.0); }  // from the eye
#endif

#endif
