// The parameters of composite.frag.glsl (documented there), and the values derived from them for all pixels.
#ifndef COMPOSITE_SETTINGS_GLSL
#define COMPOSITE_SETTINGS_GLSL

#include "bloom/bright.glsl"
#include "tone_curve.glsl"

#ifndef ABERRATION
#define ABERRATION 0
#endif
#ifndef WHITE_BALANCE
#define WHITE_BALANCE 0
#endif
#ifndef VIGNETTE
#define VIGNETTE 0
#endif
#ifndef GRADING
#define GRADING 0
#endif
#ifndef GRAIN
#define GRAIN 0
#endif

#ifdef HAS_EXPOSURE
layout(std140) uniform exposure { vec4 adapted; };  // a storage block would cost three tenths of a copy in software
#endif
#if defined(HAS_EV) || defined(HAS_THRESHOLD) || defined(HAS_LUT) || ABERRATION || WHITE_BALANCE || VIGNETTE || GRADING || GRAIN
layout(std140) uniform Parameters {
#ifdef HAS_EV
  float ev;
  float bloom_strength;
  float white;
#endif
#ifdef HAS_THRESHOLD
  float threshold;
  float knee;
#endif
#ifdef HAS_LUT
  float lut_strength;
#endif
#if ABERRATION
  float aberration_px;
#endif
#if WHITE_BALANCE
  float temperature;
  float tint;
#endif
#if VIGNETTE
  float vignette_stops;
#endif
#if GRADING
  float saturation;
  float contrast;
  vec3 lift;
  vec3 gamma;
  vec3 gain;
#endif
#if GRAIN
  float grain_strength;
#endif
};
#endif
#ifndef HAS_EV
const float ev = 0.0, bloom_strength = 0.05, white = 8.0;
#endif
#ifndef HAS_THRESHOLD
const float threshold = 0.0, knee = 0.0;
#endif

struct Settings {
  float exposure;  // factor
  float white;     // see tone_curve.glsl
  float bloom;     // share
  vec3 bright;     // see bloom/bright.glsl
};

Settings settingsOf() {
  Settings settings = Settings(exp2(ev), curveWhite(white), bloom_strength, brightOf(threshold, knee));
#ifdef HAS_EXPOSURE
  if (adapted.x > 0.0) settings.exposure *= adapted.x;
#endif
  return settings;
}

#endif
