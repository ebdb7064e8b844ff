// First step of the bloom pyramid: the bright part at half the size. Scene-referred. One NaN texel stays one texel.
// Of an odd number of texels each result has a share of three, so that light stays where it is.
// read    source   full size, nearest
// write   result   half size
// params  threshold  luminance-like level (largest channel) where bloom begins; 0 lets everything through unchanged
//         knee       width of the soft start as a fraction of the threshold, 0..1; 0 is a hard edge [0.5]
//         firefly    define, default 1: texels weigh 1 / (1 + luminance), so that a single bright one cannot flash
//                    (Karis, "Next generation post processing in Call of Duty", SIGGRAPH 2014, slide 166)
//         EVEN       define, default 0; 1: both sides of the source are even, half the cost
#include "common/finite.glsl"
#include "bright.glsl"

#ifndef FIREFLY
#define FIREFLY 1
#endif
#ifndef EVEN
#define EVEN 0
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

// Of the texels 2 i to 2 i + 2 of 2 m + 1, result i has m - i, m and i + 1 parts; of an even number it has two texels.
vec3 partsOf(int i, int count) {
  return (count & 1) == 0 ? vec3(1.0, 1.0, 0.0) : vec3(count / 2 - i, count / 2, i + 1);
}

void main() {
  ivec2 size = textureSize(source, 0);
  bright = brightOf(threshold, knee);
#if EVEN
  // A nearest lookup costs less than a fetch in software.
  vec2 texel = 1.0 / vec2(size), middle = 2.0 * gl_FragCoord.xy * texel;
  for (int i = 0; i < 4; ++i) add(textureLod(source, middle + (vec2(i & 1, i >> 1) - 0.5) * texel, 0.0).rgb, 1.0);
#else
  ivec2 corner = ivec2(gl_FragCoord.xy) * 2;
  vec3 across = partsOf(corner.x / 2, size.x), along = partsOf(corner.y / 2, size.y);
  for (int i = 0; i < 9; ++i) {
    float taken = across[i % 3] * along[i / 3];
    ivec2 at = min(corner + ivec2(i % 3, i / 3), size - 1);
    if (taken > 0.0) add(texelFetch(source, at, 0).rgb, taken);
  }
#endif
  result = vec4(sum / weights, 1.0);
}
