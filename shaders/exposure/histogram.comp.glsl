// A histogram of log2 luminance, of the mean of the central 2 x 2 of every 4 x 4 texels. Scene-referred.
// read    source      `as linear`; one thread for each 4 x 4 texels of it
// modify  histogram   BINS counts, see histogram.glsl; cleared to 0 before
#include "histogram.glsl"

layout(local_size_x = 16, local_size_y = BINS / 16) in;
uniform sampler2D source;
layout(std430) buffer histogram { uint counts[kBins]; };
shared uint group_counts[kBins];

void main() {
  group_counts[gl_LocalInvocationIndex] = 0u;
  barrier();
  ivec2 size = textureSize(source, 0);
  if (all(lessThan(gl_GlobalInvocationID.xy, uvec2(max(size / 4, 1))))) {
    vec3 color = textureLod(source, (4.0 * vec2(gl_GlobalInvocationID.xy) + 2.0) / vec2(size), 0.0).rgb;
    // A NaN fails the comparison, and so counts as black.
    float luminance = dot(color, vec3(0.2126, 0.7152, 0.0722));
    float bin = luminance > exp2(kDarkest) ? binOf(min(luminance, 65504.0)) : 0.0;
    // A sample is split between the two nearest bins, so that the mean changes continuously.
    uint upper = uint(fract(bin) * float(kUnit) + 0.5);
    atomicAdd(group_counts[uint(bin)], kUnit - upper);
    if (upper > 0u) atomicAdd(group_counts[min(uint(bin) + 1u, kBins - 1u)], upper);
  }
  barrier();
  uint found = group_counts[gl_LocalInvocationIndex];
  if (found > 0u) atomicAdd(counts[gl_LocalInvocationIndex], found);
}
