// Fog between the eye and what is shaded: scene-referred; light from afar is replaced by the fog's own, exponentially in the length
// of the ray (Beer and Lambert), in air that thins out with height (Wenzel, "Real-time atmospheric effects in games", SIGGRAPH 2006).
// Each surface has the fog before it when it is drawn, so that what covers a pixel in part blends with what is behind it fog and all.
// read    air?   buffer of fog/air.comp.glsl, `as uniform`; without it there is no fog, and no code for it
#ifndef FOG_FOG_GLSL
#define FOG_FOG_GLSL

#ifdef HAS_AIR
#include "common/view.glsl"

layout(std140) uniform air {
  vec4 fog_light;  // radiance of endless fog, extinction per world unit at the height `base`
  vec4 fog_shape;  // falloff, base, layer, sky: see air.comp.glsl
};

// Share of the light that comes through over the world vector `ray` from the eye on.
float fogTransmittance(vec3 ray) {
  float falloff = fog_shape.x, climb = falloff * ray.y;
  // (1 - e^-x) / x; for small x, where the difference would lose its digits, by its series.
  float mean = abs(climb) < 1e-2 ? 1.0 - climb * (0.5 - climb / 6.0) : (1.0 - exp(min(-climb, 60.0))) / climb;
  return exp(-fog_light.w * exp(min(-falloff * (eye.y - fog_shape.y), 60.0)) * length(ray) * mean);
}

// `light` of a surface that is `ray` away from the eye, world units.
vec3 throughFog(vec3 light, vec3 ray) { return mix(fog_light.rgb, light, fogTransmittance(ray)); }

// `light` of the sky in a direction whose component along the view axis is 1. The sky has no distance: before it the fog is a layer that
// ends above and below the eye, so it is thickest at the horizon.
vec3 skyThroughFog(vec3 light, vec3 direction) {
  float through = fogTransmittance(direction * min(fog_shape.z / max(abs(direction.y), 1e-12), 1e6));
  return mix(fog_light.rgb, light, mix(1.0, through, fog_shape.w));
}
#else
vec3 throughFog(vec3 light, vec3 ray) { return light; }
vec3 skyThroughFog(vec3 light, vec3 direction) { return light; }
#endif

#endif
