// The part of the picture that blooms. The pyramid begins with it and the composite takes it away again where its blur is
// added, so that light moves and is not made or lost.
#ifndef BLOOM_BRIGHT_GLSL
#define BLOOM_BRIGHT_GLSL

// What lies above the threshold in the largest channel, the hue kept; `knee` is the width of the soft start as a fraction of
// the threshold. At threshold 0 all of it. The threshold, half the width of the start, and how steep that is.
vec3 brightOf(float threshold, float knee) {
  float soft = threshold * knee;
  return vec3(threshold, soft, 1.0 / max(4.0 * soft, 1e-6));
}

float peakOf(vec3 color) { return max(max(color.r, color.g), max(color.b, 1e-6)); }

// Of a color with this peak: its bright part is color * brightPeak / peak.
float brightPeak(float peak, vec3 bright) {
  float ramp = clamp(peak - bright.x + bright.y, 0.0, 2.0 * bright.y);
  return max(ramp * ramp * bright.z, peak - bright.x);
}

#endif
