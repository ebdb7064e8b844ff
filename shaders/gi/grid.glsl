// A grid of light probes in a buffer, which spheres/probes/bake.comp.glsl writes.
// probes   buffer; the define PROBES_ACCESS is its qualifier, readonly by default
#ifndef GI_GRID_GLSL
#define GI_GRID_GLSL

#ifndef PROBES_ACCESS
#define PROBES_ACCESS readonly
#endif

layout(std430) PROBES_ACCESS buffer probes {
  vec4 probes_low;     // xyz: world position of the first probe
  vec4 probes_high;    // of the last one
  uvec4 probes_count;  // along x, y and z
  vec4 probe_sh[];     // nine per probe, rgb in xyz; probe (i, j, k) is number i + count.x * (j + count.y * k)
};

// Position of probe (i, j, k). A single probe along an axis is in the middle.
vec3 probePosition(vec3 low, vec3 high, uvec3 count, uvec3 probe) {
  vec3 share = vec3(probe) / vec3(max(count, uvec3(2u)) - 1u);
  return mix(low + (high - low) * share, 0.5 * (low + high), equal(count, uvec3(1u)));
}

#endif
