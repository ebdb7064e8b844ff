// What split finds to do in a texel of the fields, as a depth: tests against it skip the others.
#ifndef DOF_IDLE_GLSL
#define DOF_IDLE_GLSL

#include "coc.glsl"

// Nearer than the first far_bokeh has work, beyond the second far_hidden.
const float kBusy = 0.3, kHidden = 0.7;

// `small`: radius in pixels of the largest disc there that small/gather.comp.glsl gathers. 0.01: a depth of 16 bits is not exact.
float workOf(bool busy, bool hidden, float small) {
  return (busy ? 0.01 : hidden ? 0.76 : 0.385) + 0.2 * small / kLarge;
}
vec4 smallIn(vec4 work) { return max(mod(work, vec4(0.375)) - 0.01, vec4(0.0)) * (kLarge / 0.2); }

#endif
