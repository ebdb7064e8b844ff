// First step of the bloom pyramid: the bright part at half the size. Scene-referred. One NaN texel stays one texel.
// read    source   full size, nearest
// write   result   half its size or more: each texel stands for two by two. Beyond the source's edge its mirror image goes on, so that
//                  light is neither lost nor made there
// params  threshold  luminance-like level (largest channel) where bloom begins; 0 lets everything through unchanged
//         knee       width of the soft start as a fraction of the threshold, 0..1; 0 is a hard edge [0.5]
//         firefly    define, default 1: texels weigh 1 / (1 + luminance), so that a single bright one cannot flash
//                    (Karis, "Next generation post processing in Call of Duty", SIGGRAPH 2014, slide 166)
#include "common/finite.glsl"
#include "bright.glsl"

#ifndef FIREFLY
#define FIREFLY 1
#endif

uniform sampler2D source;
layout(std140) uniform Parameters {
  float threshold;
#ifdef HAS_KNEE
  float knee;
#endif
};
#ifndef HAS_KNEE
const float knee = 0.5;
#endif
out vec4 result;

vec3 sum = vec3(0.0), bright;
float weights = 0.0;

void add(vec3 texel) {
  vec3 color = finite(texel);
  float peak = peakOf(color), above = brightPeak(peak, bright);
  // The bright part is color * above / peak: one division for it and its weight.
#if FIREFLY
  float share = 1.0 / (peak + above * dot(color, vec3(0.2126, 0.7152, 0.0722))), weight = peak * share;
#else
  float share = 1.0 / peak, weight = 1.0;
#endif
  sum += color * (above * share);
  weights += weight;
}

void main() {
  bright = brightOf(threshold, knee);
  // A nearest lookup costs less than a fetch in software.
  vec2 texel = 1.0 / vec2(textureSize(source, 0)), middle = 2.0 * gl_FragCoord.xy * texel;
  for (int i = 0; i < 4; ++i) {
    vec2 at = middle + (vec2(i & 1, i >> 1) - 0.5) * texel;
    add(textureLod(source, 1.0 - abs(1.0 - at), 0.0).rgb);
  }
  result = vec4(sum / weights, 1.0);
}
