// Reads a grid of light probes (gi/grid.glsl) at a point: irradiance in units of an environment of radiance 1.
// probes   buffer: of spheres/probes/bake.comp.glsl
// sh?      a 3D texture that gi/textures.comp.glsl makes of it, `as linear`: seven parts along z; channel c of part i has number
//          4 i + c of the 27 (coefficient * 3 + channel); the last channel is zero. No lookup reaches from one part into another
#ifndef GI_PROBES_GLSL
#define GI_PROBES_GLSL

#include "gi/grid.glsl"
#include "gi/sh.glsl"

#ifdef HAS_SH
uniform sampler3D sh;
#endif

// The nine coefficients at a place, rgb; outside the box those of its nearest point. Returns the falloff outside the box, as leftOutside()
// in tests/theory/gi. Textures and buffer differ only by the rounding to half floats.
float probeAt(vec3 position, out vec3 c[9]) {
  vec3 count = vec3(probes_count.xyz), extent = probes_high.xyz - probes_low.xyz;
  vec3 nearest = clamp(position, probes_low.xyz, probes_high.xyz) - probes_low.xyz;
  vec3 at = nearest / max(extent, vec3(1e-20)) * (count - 1.0);
#ifdef HAS_SH
  vec3 uvw = (at + 0.5) / (count * vec3(1.0, 1.0, 7.0)), on = vec3(0.0, 0.0, 1.0 / 7.0);
  vec4 t0 = textureLod(sh, uvw, 0.0), t1 = textureLod(sh, uvw + on, 0.0), t2 = textureLod(sh, uvw + 2.0 * on, 0.0);
  vec4 t3 = textureLod(sh, uvw + 3.0 * on, 0.0), t4 = textureLod(sh, uvw + 4.0 * on, 0.0), t5 = textureLod(sh, uvw + 5.0 * on, 0.0);
  c[0] = t0.xyz;
  c[1] = vec3(t0.w, t1.xy);
  c[2] = vec3(t1.zw, t2.x);
  c[3] = t2.yzw;
  c[4] = t3.xyz;
  c[5] = vec3(t3.w, t4.xy);
  c[6] = vec3(t4.zw, t5.x);
  c[7] = t5.yzw;
  c[8] = textureLod(sh, uvw + 6.0 * on, 0.0).xyz;
#else
  for (int i = 0; i < 9; ++i) c[i] = vec3(0.0);
  uvec3 last = probes_count.xyz - 1u, low = min(uvec3(at), last), high = min(low + 1u, last);
  vec3 part = at - vec3(low);
  for (int corner = 0; corner < 8; ++corner) {
    bvec3 up = bvec3((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
    vec3 weights = mix(1.0 - part, part, up);
    uvec3 probe = uvec3(up.x ? high.x : low.x, up.y ? high.y : low.y, up.z ? high.z : low.z);
    uint first = 9u * (probe.x + probes_count.x * (probe.y + probes_count.y * probe.z));
    for (uint i = 0u; i < 9u; ++i) c[i] += weights.x * weights.y * weights.z * probe_sh[first + i].xyz;
  }
#endif
  vec3 away = position - 0.5 * (probes_low.xyz + probes_high.xyz), edge = nearest - 0.5 * extent;
  float spread = dot(extent, extent) / 64.0;
  return (dot(edge, edge) + spread) / max(dot(away, away) + spread, 1e-20);
}

// Irradiance of a surface, not below zero. `normal`: unit, world.
vec3 probeIrradiance(vec3 c[9], vec3 normal) {
  float y[9];
  shBasis(normal, y);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 9; ++i) sum += y[i] * c[i];
  return max(sum, vec3(0.0));
}

#endif
