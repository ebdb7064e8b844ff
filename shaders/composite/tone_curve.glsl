// Tone curves: scene-referred radiance, exposed, to display-referred linear light in 0..1. Chosen by CURVE, one of
// CURVE_LINEAR, CURVE_REINHARD, CURVE_FILMIC (default), CURVE_ACES; `white` is the value that becomes 1.
#ifndef COMPOSITE_TONE_CURVE_GLSL
#define COMPOSITE_TONE_CURVE_GLSL

#ifndef CURVE
#define CURVE 2
#define CURVE_LINEAR 0
#define CURVE_REINHARD 1
#define CURVE_FILMIC 2
#define CURVE_ACES 3
#endif

// Hable, "Uncharted 2: HDR lighting", GDC 2010: toe, linear part and shoulder as one rational function.
vec3 hable(vec3 x) {
  return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.50) + 0.06) - 0.0666666667;
}

vec3 toneCurve(vec3 color, float white) {
#if CURVE == CURVE_LINEAR
  return color / white;
#elif CURVE == CURVE_REINHARD
  // Reinhard et al. 2002, equation 4, per channel.
  return color * (1.0 + color / (white * white)) / (1.0 + color);
#elif CURVE == CURVE_ACES
  // Narkowicz 2015, a fit of the ACES reference transform; its own white is about 6.6.
  color *= 6.6 / white;
  return color * (2.51 * color + 0.03) / (color * (2.43 * color + 0.59) + 0.14);
#else
  // The gain puts middle grey, 0.18, near 0.18 for whites around 4 to 10.
  const float gain = 3.0;
  return hable(color * gain) / hable(vec3(white * gain)).r;
#endif
}

#endif
