// Slots and parameters of sky/skybox, for both of its stages.
#ifndef SKY_MAPS_GLSL
#define SKY_MAPS_GLSL

#include "common/equirect.glsl"

#ifndef FADE
#define FADE 0
#endif

uniform sampler2D sky;
#if FADE
uniform sampler2D sky_before;
#endif
#ifdef HAS_BLURRED
uniform sampler2D blurred;
#if FADE
uniform sampler2D blurred_before;
#endif
#endif

#if defined HAS_SKY_TURN || defined HAS_BLUR || FADE
layout(std140) uniform Parameters {
#ifdef HAS_SKY_TURN
  float sky_turn;
#endif
#ifdef HAS_BLUR
  float blur;
#endif
#if FADE
  float fade;
#endif
};
#endif
#ifndef HAS_SKY_TURN
const float sky_turn = 0.0;
#endif
#ifndef HAS_BLUR
const float blur = 0.0;
#endif

#endif
