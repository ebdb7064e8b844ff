// Light probes as a 3D texture, which hardware filters.
// read    probes   see gi/grid.glsl
// write   sh       rgba16f, seven texels a probe: see gi/probes.glsl
#include "gi/grid.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(rgba16f) uniform writeonly image3D sh;

void main() {
  uvec3 at = gl_GlobalInvocationID;
  if (any(greaterThanEqual(at, probes_count.xyz))) return;
  uint first = 9u * (at.x + probes_count.x * (at.y + probes_count.y * at.z));
  vec3 c[9];
  for (uint i = 0u; i < 9u; ++i) c[i] = probe_sh[first + i].xyz;
  ivec3 texel = ivec3(at), on = ivec3(0, 0, probes_count.z);
  imageStore(sh, texel, vec4(c[0], c[1].x));
  imageStore(sh, texel + on, vec4(c[1].yz, c[2].xy));
  imageStore(sh, texel + 2 * on, vec4(c[2].z, c[3]));
  imageStore(sh, texel + 3 * on, vec4(c[4], c[5].x));
  imageStore(sh, texel + 4 * on, vec4(c[5].yz, c[6].xy));
  imageStore(sh, texel + 5 * on, vec4(c[6].z, c[7]));
  imageStore(sh, texel + 6 * on, vec4(c[8], 0.0));
}
