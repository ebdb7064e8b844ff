// Fog in front of the sky; slots as in fog.glsl.
#ifndef FOG_SKY_GLSL
#define FOG_SKY_GLSL

#include "fog.glsl"

#ifdef HAS_AIR
// Transmittance towards the sky, for a lobe of GGX's `alpha` around a direction, from a place of that `height`. The sky has no distance, so
// the fog in front of it is a layer that ends above the eye and below it, there at the ground or deeper; it is thickest at the horizon. A lobe
// sees it at its mean height, above and below by their shares: 0.05 off the integral over the lobe in the mean.
float throughFogOfSky(vec3 direction, float height, float alpha) {
  float across = inversesqrt(dot(direction, direction)) * direction.y, y = max(sqrt(mix(0.25 * alpha * alpha, 1.0, across * across)), 1e-12);
  float far = min(fog_shape.y / y, 1e6), far_below = min(max(fog_shape.y, height - fog_light.w) / y, 1e6);
  float above = throughFog(height, y * far, far), below = throughFog(height, -y * far_below, far_below);
  return mix(1.0, mix(above, below, 0.5 - 0.5 * clamp(across / y, -1.0, 1.0)), fog_shape.z);
}

float throughFogOfSky(vec3 direction) { return throughFogOfSky(direction, eye.y, 0.0); }  // from the eye
#endif

#endif
