// Atmospheric fog: scene-referred; light from afar is replaced by the fog's own, exponentially in the length of the ray
// (Beer and Lambert), in air that thins out with height (Wenzel, "Real-time atmospheric effects in games", SIGGRAPH 2006).
#ifndef COMPOSITE_FOG_GLSL
#define COMPOSITE_FOG_GLSL

#include "common/view.glsl"

// Share of the light that comes through from a point of reversed-Z `depth`. `density` is the extinction per world unit at the
// height `base`; in 1 / `falloff` world units of height it falls to 1/e, and with `falloff` 0 it is the same everywhere. The sky
// has no distance: before it the fog is a layer that ends `layer` world units above and below the eye, so it is thickest at the
// horizon; `sky` is how much of that layer counts.
float fogTransmittance(vec2 target_uv, float depth, float density, float falloff, float base, float layer, float sky) {
  vec3 ray = viewRay(target_uv);
  float slant = length(ray);
  float range = min(depth > 0.0 ? near_plane / depth : layer / max(abs(ray.y), 1e-12), 1e6) * slant;
  float climb = falloff * range * ray.y / slant;
  // (1 - e^-x) / x; for small x, where the difference would lose its digits, by its series.
  float mean = abs(climb) < 1e-2 ? 1.0 - climb * (0.5 - climb / 6.0) : (1.0 - exp(min(-climb, 60.0))) / climb;
  float through = exp(-density * exp(min(-falloff * (eye.y - base), 60.0)) * range * mean);
  return depth > 0.0 ? through : mix(1.0, through, sky);
}

#endif
