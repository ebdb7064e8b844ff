// The part of the picture that blooms. The pyramid begins with it and the composite takes it away again where its blur is
// added, so that light moves and is not made or lost.
#ifndef BLOOM_BRIGHT_GLSL
#define BLOOM_BRIGHT_GLSL

// What lies above `threshold` in the largest channel, the hue kept; `knee` is the width of the soft start as a fraction of
// the threshold. At threshold 0 all of it.
vec3 brightPart(vec3 color, float threshold, float knee) {
  float peak = max(max(color.r, color.g), max(color.b, 1e-6));
  float soft = threshold * knee;
  float ramp = clamp(peak - threshold + soft, 0.0, 2.0 * soft);
  ramp = ramp * ramp / max(4.0 * soft, 1e-6);
  return color * (max(ramp, peak - threshold) / peak);
}

#endif
