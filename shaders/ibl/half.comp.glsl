// The next level of an equirectangular map, or of two of the same size: the mean of 2 x 2 texels, weighted by solid angle. A plain mean is
// wrong at the poles, where the solid angles of the two rows next to the pole differ by a factor of three.
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

const float kPi = 3.14159265358979;

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), last = textureSize(source, 0) - 1;
  float row = kPi / float(last.y + 1), first = sin((float(2 * at.y) + 0.5) * row);
  float second = sin((float(min(2 * at.y + 1, last.y)) + 0.5) * row);
  vec2 shares = vec2(first, second) / (2.0 * (first + second));
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 4; ++i) sum += shares[i >> 1] * texelFetch(source, min(2 * at + ivec2(i & 1, i >> 1), last), 0);
  imageStore(result, at, sum);  // outside of the map nothing is stored
#ifdef HAS_REST_RESULT
  sum = vec4(0.0);
  for (int i = 0; i < 4; ++i) sum += shares[i >> 1] * texelFetch(rest, min(2 * at + ivec2(i & 1, i >> 1), last), 0);
  imageStore(rest_result, at, sum);
#endif
}
