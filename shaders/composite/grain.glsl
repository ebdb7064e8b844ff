// Film grain: monochrome noise on encoded values, zero in the mean, new in every frame and the same for the same frame.
#ifndef COMPOSITE_GRAIN_GLSL
#define COMPOSITE_GRAIN_GLSL

// Jarzynski and Olano, "Hash functions for GPU rendering", JCGT 2020: pcg3d.
uvec3 hash3(uvec3 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v ^= v >> 16u;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  return v;
}

// Encoded values 0..1; strength is the largest deviation, 0..0.2, reached at 0.5. It fades to black and white as x (1 - x), so
// that up to 0.25 nothing is ever clipped and the mean is kept.
vec3 addGrain(vec3 encoded, ivec2 pixel, uint frame_number, float strength) {
  uvec3 bits = hash3(uvec3(uvec2(pixel), frame_number)) >> 8u;
  float noise = (float(bits.x) - float(bits.y)) / 16777216.0;  // triangular, -1..1
  return encoded + strength * noise * 4.0 * encoded * (1.0 - encoded);
}

#endif
