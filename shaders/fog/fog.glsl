// Fog between the eye and a surface, scene-referred: light is replaced by the fog's own, exponentially in the length of the ray (Beer and
// Lambert), in air whose density falls with height (Wenzel, "Real-time atmospheric effects in games", SIGGRAPH 2006). Surfaces are fogged
// while they are drawn, so that a partly covered pixel blends fogged colors.
// read    air?   buffer of fog/air.comp.glsl, `as uniform`; without it there is no fog, and no code for it
#ifndef FOG_FOG_GLSL
#define FOG_FOG_GLSL

#ifdef HAS_AIR
layout(std140) uniform air {
  vec4 fog_light;  // radiance of endless fog, extinction per world unit at the height of the eye
  vec4 fog_shape;  // falloff, layer, sky: see air.comp.glsl; w: logarithm of the extinction at the eye
};

// Transmittance along the world vector `ray` from the eye.
float throughFog(vec3 ray) {
  float climb = fog_shape.x * ray.y;
  // The mean of e^(w - x) for x from 0 to `climb`; for small ones by its series, because the difference would cancel. Exponents are added
  // first: high above the fog the extinction at the eye underflows, although there is fog below.
  float mean = abs(climb) < 2e-3 ? fog_light.w * (0.5 * climb - 1.0) : (exp(min(fog_shape.w - climb, 60.0)) - fog_light.w) / climb;
  return exp(length(ray) * mean);
}
#endif

#endif
