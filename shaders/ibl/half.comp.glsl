// The next level of a map, or of two of the same size: the mean of 2 x 2 texels.
// read    source, rest?          one level of each
// write   result, rest_result?   the level below it, rgba16f
layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D source;
layout(rgba16f) uniform writeonly image2D result;
#ifdef HAS_REST
uniform sampler2D rest;
#endif
#ifdef HAS_REST_RESULT
layout(rgba16f) uniform writeonly image2D rest_result;
#endif

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), last = textureSize(source, 0) - 1;
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 4; ++i) sum += texelFetch(source, min(2 * at + ivec2(i & 1, i >> 1), last), 0);
  imageStore(result, at, 0.25 * sum);  // outside of the map nothing is stored
#ifdef HAS_REST_RESULT
  sum = vec4(0.0);
  for (int i = 0; i < 4; ++i) sum += texelFetch(rest, min(2 * at + ivec2(i & 1, i >> 1), last), 0);
  imageStore(rest_result, at, 0.25 * sum);
#endif
}
