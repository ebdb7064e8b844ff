// Slots and parameters of sky/skybox, for both of its stages.
#ifndef SKY_MAPS_GLSL
#define SKY_MAPS_GLSL

#include "common/equirect.glsl"
#include "ibl/brightest.glsl"

uniform sampler2D sky;
#ifdef HAS_BLURRED
uniform sampler2D blurred;
#endif
#ifdef HAS_ENLARGED
uniform sampler2D enlarged;
#endif
#ifdef HAS_DISC
layout(std140) uniform disc {
  vec4 disc_at;
  vec4 disc_light;
};
#endif

#if defined HAS_SKY_TURN || defined HAS_BLUR || defined HAS_ROWS
layout(std140) uniform Parameters {
#ifdef HAS_SKY_TURN
  float sky_turn;
#endif
#ifdef HAS_BLUR
  float blur;
#endif
#ifdef HAS_ROWS
  float rows;
#endif
};
#endif
#ifndef HAS_SKY_TURN
const float sky_turn = 0.0;
#endif
#ifndef HAS_BLUR
const float blur = 0.0;
#endif
#ifndef HAS_ROWS
const float rows = 1.0;
#endif

#endif
