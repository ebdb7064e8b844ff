// Light probes: a grid of points, each with the light that spheres throw back to it, as irradiance in spherical harmonics up to
// band 2, in units of the environment: a sphere's diffuse color, albedo * (1 - metallic), is its radiance, as it is under an
// environment of radiance 1. Spheres hide neither each other nor the sky. One thread per probe.
// read    instances   the spheres
//         box         of spheres/probes/box.comp.glsl
// write   probes      see gi/grid.glsl
// params  count       spheres
//         grid        probes along x, y and z
//         near, far   in radii from a sphere's center: the range of probes that it lights
// defines SHAPE       SHAPE_CAP: the cap of the sky that a sphere covers; SHAPE_POINT: a point as strong
//         WINDOW      WINDOW_SMOOTH: light ends at `far` by (1 - x^4)^2; WINDOW_HARD: at once
#define PROBES_ACCESS writeonly
#include "gi/grid.glsl"
#include "gi/sh.glsl"
#include "scene/instances.glsl"

layout(local_size_x = 64) in;
layout(std430) readonly buffer box { vec4 box_low, box_high; };
layout(std140) uniform Parameters {
  uint count;
  uvec3 grid;
  float near;
  float far;
};

void main() {
  uint self = gl_GlobalInvocationID.x;
  if (self >= grid.x * grid.y * grid.z) return;
  if (self == 0u) {
    probes_low = box_low;
    probes_high = box_high;
    probes_count = uvec4(grid, 0u);
  }
  vec3 position = probePosition(box_low.xyz, box_high.xyz, grid, uvec3(self % grid.x, self / grid.x % grid.y, self / (grid.x * grid.y)));
  vec3 sums[9];
  for (int i = 0; i < 9; ++i) sums[i] = vec3(0.0);
  for (uint k = 0u; k < count; ++k) {
    vec3 offset = instance[k].center - position;
    float d2 = dot(offset, offset), r2 = instance[k].radius * instance[k].radius;
    if (!(r2 > 0.0) || !(d2 >= near * near * r2) || !(d2 < far * far * r2)) continue;
    float sine = sqrt(r2 / d2);
#if SHAPE == SHAPE_CAP
    vec3 bands = capBands(sine) * kCosineLobe;
#else
    vec3 bands = pointBands(sine) * kCosineLobe;
#endif
#if WINDOW == WINDOW_SMOOTH
    float x2 = d2 / (far * far * r2), left = 1.0 - x2 * x2;
    bands *= left * left;
#endif
    vec3 color = instance[k].albedo * (1.0 - instance[k].metallic);
    float y[9];
    shBasis(offset / sqrt(d2), y);
    for (int i = 0; i < 9; ++i) sums[i] += bands[i == 0 ? 0 : i < 4 ? 1 : 2] * y[i] * color;
  }
  for (uint i = 0u; i < 9u; ++i) probe_sh[9u * self + i] = vec4(sums[i], 0.0);
}
