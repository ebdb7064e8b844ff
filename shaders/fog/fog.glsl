// Fog between the eye and a surface, scene-referred: light is replaced by the fog's own, exponentially in the length of the ray (Beer and
// Lambert), in air whose density falls with height (Wenzel, "Real-time atmospheric effects in games", SIGGRAPH 2006). Surfaces are fogged
// while they are drawn, so that a partly covered pixel blends fogged colors.
// read    air?   buffer of fog/air.comp.glsl, `as uniform`; without it there is no fog, and no code for it
// define  FOG_FROM_EYE   false: none between the eye and the surface, only before what it reflects (default true)
#ifndef FOG_FOG_GLSL
#define FOG_FOG_GLSL

#ifdef HAS_AIR
#include "common/view.glsl"

layout(std140) uniform air {
  vec4 fog_light;  // radiance of endless fog; w: fog_base
  vec4 fog_shape;  // falloff, layer, sky: see air.comp.glsl; w: logarithm of the extinction per world unit at height 0
};

// Transmittance along `far` world units that climb by `up`, from a place of that `height`.
float throughFog(float height, float up, float far) {
  float begin = fog_shape.w - fog_shape.x * height, climb = fog_shape.x * up;
  float density = exp(min(begin, 60.0)), end = exp(min(begin - climb, 60.0));
  // The mean of e^(begin - x) for x from 0 to `climb`; for small ones by its series, because the difference would cancel. Exponents are added
  // first: high above the fog the extinction underflows, although there is fog below. The mean is at least what is at the thinner end: where
  // both ends are beyond e^60, their difference is 0.
  float mean = abs(climb) < 2e-3 ? density * (0.5 * climb - 1.0) : (end - density) / climb;
  return exp(far * min(mean, -min(density, end)));
}

// Along the world vector `ray` from the eye.
#if defined FOG_FROM_EYE && !FOG_FROM_EYE
float throughFog(vec3 ray) { return 1.0; }
#else
float throughFog(vec3 ray) { return throughFog(eye.y, ray.y, length(ray)); }
#endif
#endif

#endif
