// First step of the bloom pyramid: the bright part at half the size. Scene-referred. One NaN texel stays one texel.
// read    source   full size, nearest
// write   result   half its size or more: each texel is the mean of its part of the source, so that light is neither lost nor made
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
in vec2 uv;
out vec4 result;

vec3 sum = vec3(0.0), bright;
float weights = 0.0;

// A share of a texel.
void add(vec3 texel, float taken) {
  vec3 color = finite(texel);
  float peak = peakOf(color), above = brightPeak(peak, bright);
  // The bright part is color * above / peak: one division for it and its weight.
#if FIREFLY
  float share = taken / (peak + above * dot(color, vec3(0.2126, 0.7152, 0.0722))), weight = peak * share;
#else
  float share = taken / peak, weight = taken;
#endif
  sum += color * (above * share);
  weights += weight;
}

void main() {
  bright = brightOf(threshold, knee);
  // In texels of the source: the part of it, and how many it touches along each axis.
  vec2 size = vec2(textureSize(source, 0)), side = size / round(gl_FragCoord.xy / uv), low = (gl_FragCoord.xy - 0.5) * side;
  ivec2 count = 2 + ivec2(notEqual(side, vec2(2.0)));
  for (int y = 0; y < count.y; ++y)
    for (int x = 0; x < count.x; ++x) {
      vec2 texel = floor(low) + vec2(x, y), part = max(min(texel + 1.0, low + side) - max(texel, low), vec2(0.0));
      // A nearest lookup costs less than a fetch in software.
      add(textureLod(source, (texel + 0.5) / size, 0.0).rgb, part.x * part.y);
    }
  result = vec4(sum / weights, 1.0);
}
