// The next level of a map: the mean of 2 x 2 texels.
// read    source   one level
// write   result   the level below it, rgba16f
layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D source;
layout(rgba16f) uniform writeonly image2D result;

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), last = textureSize(source, 0) - 1;
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 4; ++i) sum += texelFetch(source, min(2 * at + ivec2(i & 1, i >> 1), last), 0);
  imageStore(result, at, 0.25 * sum);  // outside of the map nothing is stored
}
