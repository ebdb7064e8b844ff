// Light probes as 3D textures, which hardware filters.
// read    probes   see gi/grid.glsl
// write   sh       seven rgba16f, a texel a probe: see gi/probes.glsl
#include "gi/grid.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(rgba16f) uniform writeonly image3D sh[7];

void main() {
  uvec3 at = gl_GlobalInvocationID;
  if (any(greaterThanEqual(at, probes_count.xyz))) return;
  uint first = 9u * (at.x + probes_count.x * (at.y + probes_count.y * at.z));
  vec3 c[9];
  for (uint i = 0u; i < 9u; ++i) c[i] = probe_sh[first + i].xyz;
  ivec3 texel = ivec3(at);
  imageStore(sh[0], texel, vec4(c[0], c[1].x));
  imageStore(sh[1], texel, vec4(c[1].yz, c[2].xy));
  imageStore(sh[2], texel, vec4(c[2].z, c[3]));
  imageStore(sh[3], texel, vec4(c[4], c[5].x));
  imageStore(sh[4], texel, vec4(c[5].yz, c[6].xy));
  imageStore(sh[5], texel, vec4(c[6].z, c[7]));
  imageStore(sh[6], texel, vec4(c[8], 0.0));
}
