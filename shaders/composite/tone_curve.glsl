// Tone curves: scene-referred radiance, exposed, to display-referred linear light in 0..1. Chosen by CURVE, one of
// CURVE_LINEAR, CURVE_REINHARD, CURVE_FILMIC (default), CURVE_ACES, CURVE_AGX, CURVE_NEUTRAL. `white` is the value that
// becomes 1; agx and neutral have a white of their own and do not use it.
#ifndef COMPOSITE_TONE_CURVE_GLSL
#define COMPOSITE_TONE_CURVE_GLSL

#ifndef CURVE
#define CURVE 2
#define CURVE_LINEAR 0
#define CURVE_REINHARD 1
#define CURVE_FILMIC 2
#define CURVE_ACES 3
#define CURVE_AGX 4
#define CURVE_NEUTRAL 5
#endif

// Hable, "Uncharted 2: HDR lighting", GDC 2010: toe, linear part and shoulder as one rational function.
vec3 hable(vec3 x) {
  return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.50) + 0.06) - 0.0666666667;
}

#if CURVE == CURVE_AGX
// Sobotka's AgX, base look: Wrensch's fit (iolite-engine.com/blog_posts/minimal_agx_implementation, 2023), a polynomial of
// degree 6 over -12.47..4.03 stops about 1, between an inset of the primaries and its inverse. Made for a display of power
// 2.2, undone here because sRGB encoding follows.
vec3 agx(vec3 color) {
  const mat3 inset = mat3(0.842479062253094, 0.0423282422610123, 0.0423756549057051, 0.0784335999999992,
                          0.878468636469772, 0.0784336, 0.0792237451477643, 0.0791661274605434, 0.879142973793104);
  const mat3 outset = mat3(1.19687900512017, -0.0528968517574562, -0.0529716355144438, -0.0980208811401368,
                           1.15190312990417, -0.0980434501171241, -0.0990297440797205, -0.0989611768448433,
                           1.15107367264116);
  vec3 x = clamp((log2(max(inset * color, vec3(1e-10))) + 12.47393) / 16.5, 0.0, 1.0);
  vec3 x2 = x * x, x4 = x2 * x2;
  x = 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 + 0.1191 * x - 0.00232;
  return pow(max(outset * x, vec3(0.0)), vec3(2.2));
}
#endif

#if CURVE == CURVE_NEUTRAL
// Khronos PBR Neutral tone mapper, 2024: base colors up to 0.8 are kept, highlights are compressed and lose color.
vec3 neutral(vec3 color) {
  const float start = 0.8 - 0.04, desaturation = 0.15;
  float low = min(color.r, min(color.g, color.b));
  color -= low < 0.08 ? low - 6.25 * low * low : 0.04;
  float peak = max(start, max(color.r, max(color.g, color.b)));  // at `start` what follows changes nothing
  const float room = 1.0 - start;
  float new_peak = 1.0 - room * room / (peak + room - start);
  // The color scaled to new_peak, mixed with white of that peak.
  float share = 1.0 / (peak * (desaturation * (peak - new_peak) + 1.0));
  return new_peak * (share * color + (1.0 - share * peak));
}
#endif

const float kFilmicGain = 3.0;  // puts middle gray, 0.18, near 0.18 for whites around 4 to 10

// The factors of toneCurve() that depend on `white`: the same for all pixels.
float curveWhite(float white) {
#if CURVE == CURVE_REINHARD
  return 1.0 / (white * white);
#elif CURVE == CURVE_ACES
  return 6.6 / white;
#elif CURVE == CURVE_FILMIC
  return 1.0 / hable(vec3(white * kFilmicGain)).r;
#else
  return 1.0 / white;
#endif
}

vec3 toneCurve(vec3 color, float curve_white) {
#if CURVE == CURVE_LINEAR
  return color * curve_white;
#elif CURVE == CURVE_REINHARD
  // Reinhard et al. 2002, equation 4, per channel.
  return color * (1.0 + color * curve_white) / (1.0 + color);
#elif CURVE == CURVE_ACES
  // Narkowicz 2015, a fit of the ACES reference transform; its own white is about 6.6.
  color *= curve_white;
  return color * (2.51 * color + 0.03) / (color * (2.43 * color + 0.59) + 0.14);
#elif CURVE == CURVE_AGX
  return agx(color);
#elif CURVE == CURVE_NEUTRAL
  return neutral(color);
#else
  return hable(color * kFilmicGain) * curve_white;
#endif
}

#endif
