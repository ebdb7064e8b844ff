// Fog between the eye and what is shaded: scene-referred; light from afar is replaced by the fog's own, exponentially in the length
// of the ray (Beer and Lambert), in air that thins out with height (Wenzel, "Real-time atmospheric effects in games", SIGGRAPH 2006).
// Each surface has the fog before it when it is drawn, so that what covers a pixel in part blends with what is behind it fog and all.
// read    air?   buffer of fog/air.comp.glsl, `as uniform`; without it there is no fog, and no code for it
#ifndef FOG_FOG_GLSL
#define FOG_FOG_GLSL

#ifdef HAS_AIR
layout(std140) uniform air {
  vec4 fog_light;  // radiance of endless fog, extinction per world unit at the height of the eye
  vec4 fog_shape;  // falloff, layer, sky: see air.comp.glsl; w: logarithm of the extinction at the eye
};

// Share of the light that comes through over the world vector `ray` from the eye on.
float throughFog(vec3 ray) {
  float climb = fog_shape.x * ray.y;
  // The mean of e^(w - x) for x from 0 to `climb`; for small ones, where the difference would lose its digits, by its series. Exponents are
  // added first: high above the fog there is none at the eye that a float can tell, and below there is.
  return exp(length(ray) * (abs(climb) < 2e-3 ? fog_light.w * (0.5 * climb - 1.0) : (exp(min(fog_shape.w - climb, 60.0)) - fog_light.w) / climb));
}
#endif

#endif
