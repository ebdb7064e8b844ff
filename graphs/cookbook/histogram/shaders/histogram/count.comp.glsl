// Counts of pixels by the logarithm of their luminance, one group's first in shared memory. BINS bins cover `stops` from `darkest`.
// read    color    scene-referred
// modify  counts   uint[BINS]
layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2D color;
layout(std430) buffer counts { uint count[]; };
layout(std140) uniform Parameters { float darkest; float stops; };
shared uint here[BINS];

void main() {
  for (uint i = gl_LocalInvocationIndex; i < BINS; i += 256u) here[i] = 0u;
  barrier();
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(at, textureSize(color, 0)))) {
    float luminance = dot(texelFetch(color, at, 0).rgb, vec3(0.2126, 0.7152, 0.0722));
    float bin = (log2(max(luminance, exp2(darkest))) - darkest) / stops * float(BINS);
    atomicAdd(here[int(clamp(bin, 0.0, float(BINS - 1)))], 1u);
  }
  barrier();
  for (uint i = gl_LocalInvocationIndex; i < BINS; i += 256u)
    if (here[i] > 0u) atomicAdd(count[i], here[i]);
}
