// For each slice of depth, the lamps that reach into it; see clusters.glsl. An invocation is a word of 32 lamps of one slice.
// read    lamps     see scene/lamps.glsl
// modify  slices    uints: words of each slice, the nearest first
// params  lamp_count
#include "clusters.glsl"
#include "scene/lamps.glsl"

layout(local_size_x = 64) in;
layout(std430) buffer slices { uint slice_word[]; };
layout(std140) uniform Parameters { int lamp_count; };

// Distances along the view axis; the first begins at 0.
vec2 boundsOfSlice(int slice) {
  return vec2(slice == 0 ? -1e30 : near_plane * exp2(float(slice) / kSlicesPerOctave),
              slice == LAMP_SLICES - 1 ? 1e30 : near_plane * exp2(float(slice + 1) / kSlicesPerOctave));
}

void main() {
  int count = wordsOf(lamp_count), at = int(gl_GlobalInvocationID.x);
  if (at >= count * LAMP_SLICES) return;
  vec2 bounds = boundsOfSlice(at / count);
  uint word = 0u;
  for (int bit = 0, i = at % count * 32; bit < 32 && i < lamp_count; ++bit, ++i) {
    vec4 sphere = lampBounds(lamp[i]);
    float distance_along = viewDistance(sphere.xyz), reach = sphere.w * 1.001;
    if (distance_along + reach >= bounds.x * 0.9999 && distance_along - reach <= bounds.y * 1.0001) word |= 1u << bit;
  }
  slice_word[at] = ~word;
}
