// Auto-exposure: follows the histogram in time. One group, a thread for each bin.
// read    histogram   of histogram.comp.glsl
//         previous    the last frame's `exposure`; x below 0: there is none, the factor starts at its target
// write   exposure    vec4: the factor for radiance, its target, the mean luminance, and, after black, the seconds until the factor
//                     reaches its target
// After black, the target is taken from the first picture and the factor reaches it within kOpening, so that a picture that fades in is not
// exposed for its dimmest frame.
// params  key         target of the mean luminance
//         low, high   percentiles between which texels count, 0..1
//         speed_up, speed_down  1 / s, for a scene that has become brighter or darker: in 1 / speed seconds the distance to the
//                     target, in stops, falls to 1/e; the target is never passed, at any frame rate
//         min_ev, max_ev  bounds of the exposure in stops
#include "common/view.glsl"
#include "histogram.glsl"

layout(local_size_x = BINS) in;
layout(std430) readonly buffer histogram { uint counts[kBins]; };
layout(std430) readonly buffer previous { vec4 before; };
layout(std430) writeonly buffer exposure { vec4 adapted; };
layout(std140) uniform Parameters {
  float key;
  float low;
  float high;
  float speed_up;
  float speed_down;
  float min_ev;
  float max_ev;
};
const float kOpening = 0.25;  // s
shared uint sums[kBins];
shared vec2 parts[kBins];

void main() {
  uint i = gl_LocalInvocationIndex;
  uint count = i == 0u ? 0u : counts[i];
  sums[i] = count;
  barrier();
  for (uint hop = 1u; hop < kBins; hop *= 2u) {
    uint left = i >= hop ? sums[i - hop] : 0u;
    barrier();
    sums[i] += left;
    barrier();
  }
  // The part of this bin that lies between the two percentiles.
  float total = float(sums[kBins - 1u]);
  float from = float(sums[i] - count), to = float(sums[i]);
  float weight = max(min(to, high * total) - max(from, low * total), 0.0);
  parts[i] = vec2(weight, weight * logLuminanceOf(float(i)));
  barrier();
  for (uint hop = kBins / 2u; hop > 0u; hop /= 2u) {
    if (i < hop) parts[i] += parts[i + hop];
    barrier();
  }
  if (i != 0u) return;

  float old = before.x;
  if (parts[0].x <= 0.0) {  // black: nothing to adapt to
    adapted = old > 0.0 ? before : vec4(-1.0, -1.0, 0.0, kOpening);
    return;
  }
  float mean = parts[0].y / parts[0].x;
  float target = clamp(log2(key) - mean, min_ev, max_ev);
  float ev = target;
  float opening = max(before.w - delta_time, 0.0);
  if (before.w <= 0.0 && old > 0.0) {
    float speed = target < log2(old) ? speed_up : speed_down;
    ev = mix(target, log2(old), exp(-speed * delta_time));
  }
  adapted = vec4(exp2(ev) * max(1.0 - opening / kOpening, 1e-6), exp2(target), exp2(mean), opening);
}
