// First step of the bloom pyramid: the bright part at half the size. Scene-referred. One NaN texel stays one texel.
// read    source   full size, nearest
// write   result   half size
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

void main() {
  vec2 texel = 1.0 / vec2(textureSize(source, 0)), middle = gl_FragCoord.xy * 2.0 * texel;
  vec2 a = middle - 0.5 * texel, b = middle + 0.5 * texel;
  vec3 c[4] = vec3[4](textureLod(source, a, 0.0).rgb, textureLod(source, vec2(b.x, a.y), 0.0).rgb,
                      textureLod(source, vec2(a.x, b.y), 0.0).rgb, textureLod(source, b, 0.0).rgb);
  vec3 bright = brightOf(threshold, knee);
  vec3 sum = vec3(0.0);
  float weights = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec3 color = finite(c[i]);
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
  result = vec4(sum / weights, 1.0);
}
