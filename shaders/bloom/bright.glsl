// The bright part of the picture. The bloom pyramid starts from it, and the composite replaces it by its blur, so the total light is
// kept.
#ifndef BLOOM_BRIGHT_GLSL
#define BLOOM_BRIGHT_GLSL

// The part above the threshold, measured in the largest channel and with the hue kept; `knee` is the width of the soft start as a
// fraction of the threshold. A threshold of 0 takes everything. Members: the threshold, half the width of the start, its slope.
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
