// read    was_signed, was_volume, was_sky, was_stack, was_counts   what these held
// write   signed, volume, sky, stack, counts                      other numbers made of it
layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D was_signed;
uniform sampler3D was_volume;
uniform samplerCube was_sky;
uniform sampler2DArray was_stack;
layout(rgba8_snorm) uniform writeonly image2D signed;
layout(rgba16f) uniform writeonly image3D volume;
layout(rgba16f) uniform writeonly imageCube sky;
layout(rgba8) uniform writeonly image2DArray stack;
layout(std430) readonly buffer was_counts { uvec4 were; };
layout(std430) writeonly buffer counts { uvec4 are; };

vec4 following(vec4 was, ivec3 at) { return fract(was * 1.7 + 0.13 + 0.03 * at.x + 0.07 * at.y + 0.11 * at.z); }

void main() {
  ivec3 at = ivec3(gl_GlobalInvocationID);
  if (at == ivec3(0)) are = were * 3u + uvec4(1u, 2u, 3u, 4u);
  if (at.z == 0 && all(lessThan(at.xy, imageSize(signed))))
    imageStore(signed, at.xy, following(texelFetch(was_signed, at.xy, 0), at) * 2.0 - 1.0);
  if (all(lessThan(at, imageSize(volume)))) imageStore(volume, at, following(texelFetch(was_volume, at, 0), at));
  if (all(lessThan(at.xy, imageSize(sky)))) imageStore(sky, at, following(textureLod(was_sky, vec3(at) - 1.5, 0.0), at));
  if (at.z < 3) imageStore(stack, at, following(texelFetch(was_stack, ivec3(at.xy / 2, at.z), 1), at));
}
