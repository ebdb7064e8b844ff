// Scene-referred to display-referred: bloom, exposure, tone curve, sRGB encoding, dither. The last pass that sees
// radiance; what follows works on encoded values.
// read    color   scene-referred radiance; any sampler (texels are fetched)
//         bloom?  scene-referred, any size; `as linear` unless its size is the target's
// write   result  display-referred, sRGB encoded
// params  all three, or none for the values in brackets:
//         ev              exposure in stops; +1 doubles [0]
//         bloom_strength  share of bloom in the mix, 0..1: the picture is mixed, not brightened [0.05]
//         white           radiance, after exposure, that becomes white [8]
//         curve           CURVE, see tone_curve.glsl
//         dither          define, default 1: half a step of noise either way before rounding to 8 bits
//                         (interleaved gradient noise, Jimenez, SIGGRAPH 2014; uniform, so means are kept)
#include "common/srgb.glsl"
#include "tone_curve.glsl"

#ifndef DITHER
#define DITHER 1
#endif

uniform sampler2D color;
#ifdef HAS_BLOOM
uniform sampler2D bloom;
#endif
#ifdef HAS_EV
layout(std140) uniform Parameters {
  float ev;
  float bloom_strength;
  float white;
};
#else
const float ev = 0.0, bloom_strength = 0.05, white = 8.0;
#endif
in vec2 uv;
out vec4 result;

void main() {
  vec3 c = texelFetch(color, ivec2(gl_FragCoord.xy), 0).rgb;
#ifdef HAS_BLOOM
  c = mix(c, textureLod(bloom, uv, 0.0).rgb, bloom_strength);
#endif
  c = toneCurve(max(c * exp2(ev), vec3(0.0)), white);
  c = encodeSrgb(clamp(c, 0.0, 1.0));
#if DITHER
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  c += (noise - 0.5) / 255.0;
#endif
  result = vec4(c, 1.0);
}
