// For W183: it stores into an image that its pass says it reads.
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba8) uniform image2D picture;
layout(std430) writeonly buffer sums { uint sum[]; };

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  imageStore(picture, at, imageLoad(picture, at).grba);
  sum[at.x] = 0u;
}
