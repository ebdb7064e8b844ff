// read    floats … counts   what the frame has
// write   result            all of it, added up
// params  ages              in seconds
uniform sampler2D floats, d24s8, third, follower, slow, was_slow, slower, seed;
uniform sampler2DArray stack;
uniform sampler3D volume;
layout(std430) readonly buffer counts { uvec4 are; };
layout(std140) uniform Parameters { vec4 ages; };
out vec4 result;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  result = texelFetch(stack, ivec3(at / 4, 2), 2) + texelFetch(volume, ivec3(at / 2, 1), 0) + texelFetch(d24s8, at, 0) +
           texelFetch(third, ivec2(0), 0) + texelFetch(follower, ivec2(0), 0) + 10.0 * texelFetch(slow, at, 0) + 20.0 * texelFetch(was_slow, at, 0) +
           30.0 * texelFetch(slower, at, 0) + texelFetch(seed, ivec2(0), 0) + vec4(are & 255u) + ages;
  if (at.x > 0) result += texelFetch(floats, at, 0);
}
