// First step of the bloom pyramid: the bright part at half the size. Scene-referred. One NaN texel stays one texel.
// read    source   full size, nearest
// write   result   half its size or more: each texel is the mean of its part of the source, so that light is neither lost nor made
// params  threshold  luminance-like level (largest channel) where bloom begins; 0 lets everything through unchanged
//         knee       width of the soft start as a fraction of the threshold, 0..1; 0 is a hard edge [0.5]
//         firefly    define, default 1: texels weigh 1 / (1 + luminance), so that a single bright one cannot flash
//                    (Karis, "Next generation post processing in Call of Duty", SIGGRAPH 2014, slide 166)
//         wider, higher   defines, default 1; 0: `result` has exactly half the source's columns, rows
#include "common/finite.glsl"
#include "bright.glsl"

#ifndef FIREFLY
#define FIREFLY 1
#endif
#ifndef WIDER
#define WIDER 1
#endif
#ifndef HIGHER
#define HIGHER 1
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

vec2 texel;
vec3 across;

// A row of two or three texels, from `at` on.
void addRow(vec2 at, float part) {
  vec3 shares = across * part;
  // A nearest lookup costs less than a fetch in software.
  add(textureLod(source, at, 0.0).rgb, shares.x);
  add(textureLod(source, at + vec2(texel.x, 0.0), 0.0).rgb, shares.y);
  if (WIDER == 1 && across.z > 0.0) add(textureLod(source, at + vec2(2.0 * texel.x, 0.0), 0.0).rgb, shares.z);
}

// What of a length from `start` on is in each of three texels; it starts in the first.
vec3 sharesOf(float start, float side) {
  float end = start + side;
  return vec3(min(1.0 - start, side), clamp(end - 1.0, 0.0, 1.0), max(end - 2.0, 0.0));
}

void main() {
  bright = brightOf(threshold, knee);
  // In texels of the source: the part of it, from its first texel on.
  vec2 size = vec2(textureSize(source, 0)), side = size / round(gl_FragCoord.xy / uv), low = (gl_FragCoord.xy - 0.5) * side;
  texel = 1.0 / size;
  vec2 first = (floor(low) + 0.5) * texel, start = fract(low);
  across = sharesOf(start.x, side.x);
  vec3 along = sharesOf(start.y, side.y);
  addRow(first, along.x);
  addRow(first + vec2(0.0, texel.y), along.y);
  if (HIGHER == 1 && along.z > 0.0) addRow(first + vec2(0.0, 2.0 * texel.y), along.z);
  result = vec4(sum / weights, 1.0);
}
