// Each light probe as a little sphere.
// read    probes   see gi/grid.glsl
// params  size     radius, as a share of the shortest way from probe to probe
#include "common/view.glsl"
#include "gi/debug.glsl"
#include "gi/grid.glsl"

in vec3 position;
in vec3 normal;

out vec3 outwards;             // world
flat out vec3 center;
out vec4 before;               // clip position of the last frame

void main() {
  uint self = uint(gl_InstanceID);
  uvec3 probe = uvec3(self % probes_count.x, self / probes_count.x % probes_count.y, self / (probes_count.x * probes_count.y));
  center = probePosition(probes_low.xyz, probes_high.xyz, probes_count.xyz, probe);
  vec3 gap = (probes_high.xyz - probes_low.xyz) / vec3(max(probes_count.xyz, uvec3(2u)) - 1u);
  float shortest = min(gap.x > 0.0 ? gap.x : 1e30, min(gap.y > 0.0 ? gap.y : 1e30, gap.z > 0.0 ? gap.z : 1e30));
  outwards = normal;
  vec4 world = vec4(center + position * size * (shortest < 1e30 ? shortest : 0.0), 1.0);
  before = previous_view_projection * world;
  gl_Position = view_projection * world;
}
