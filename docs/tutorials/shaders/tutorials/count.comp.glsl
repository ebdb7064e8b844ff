// read    layers  `as image`
// modify  counts  pixels by the number of their layers, 16 numbers
layout(local_size_x = 8, local_size_y = 8) in;
layout(r32ui) uniform readonly uimage2D layers;
layout(std430) buffer counts { uint count[16]; };
shared uint sums[16];

void main() {
  if (gl_LocalInvocationIndex < 16u) sums[gl_LocalInvocationIndex] = 0u;
  barrier();
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(at, imageSize(layers)))) atomicAdd(sums[min(imageLoad(layers, at).r, 15u)], 1u);
  barrier();
  if (gl_LocalInvocationIndex < 16u) atomicAdd(count[gl_LocalInvocationIndex], sums[gl_LocalInvocationIndex]);
}
