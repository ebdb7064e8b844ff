// read    grid    see voxels/fill.frag.glsl
// write   light   rgb: radiance, a: 1 where there is something
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

uniform usampler3D grid;
layout(rgba16f) uniform writeonly image3D light;

void main() {
  ivec3 voxel = ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(voxel, textureSize(grid, 0)))) return;
  vec4 packed_light = unpackUnorm4x8(texelFetch(grid, voxel, 0).r);
  imageStore(light, voxel, vec4(4.0 * packed_light.rgb * packed_light.rgb, packed_light.a));
}
