// One bounce of light: the light of the probes, in units of the environment, times the environment. Light from a direction was reflected by
// surfaces that face the opposite direction, so it is multiplied by the environment's irradiance there. Only the mean of these directions
// and their spread are known, so the irradiance is a mix of two opposite directions. This is exact where irradiance is linear in the
// direction, as under a constant environment; a black one gives no bounce.
// Needs the slots of gi/probes.glsl.
#ifndef GI_BOUNCE_GLSL
#define GI_BOUNCE_GLSL

#include "gi/probes.glsl"

struct Bounce {
  vec3 share;   // irradiance / pi of a surface, in units of the environment
  vec3 facing;  // unit: mean direction that the reflecting surfaces face
  float sure;   // near 1 where light comes along the normal alone, less where it comes from many sides, at least 1/2
};

// `c` and `left`: from probeAt().
// Cosine-weighted mean direction of the light by its moments up to band 2 (w n = cosine, F, D, T the integrals of the radiance times
// 1, w, w w'): 3/16 D + 1/2 T n + 3/16 n (n.D). See bounceOf in tests/theory/gi/probe_reading.h.
Bounce bounceOf(vec3 c[9], float left, vec3 normal) {
  const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
  float y[9], l[9], all = 0.0;
  vec3 irradiance_here = vec3(0.0);
  shBasis(normal, y);
  for (int i = 0; i < 9; ++i) {
    irradiance_here += y[i] * c[i];
    l[i] = dot(c[i], luminance);
    all += y[i] * l[i];
    l[i] /= i == 0 ? kCosineLobe.x : i < 4 ? kCosineLobe.y : kCosineLobe.z;
  }
  float flux = l[0] * 3.544907702, zz = flux / 3.0 + l[6] / 0.946174695, even = flux - zz, odd = l[8] / 0.546274215;
  vec3 d = vec3(l[3], l[1], l[2]) * 2.046653415;
  float xy = l[4] / 1.092548431, yz = l[5] / 1.092548431, xz = l[7] / 1.092548431;
  vec3 tn = vec3(0.5 * (even + odd) * normal.x + xy * normal.y + xz * normal.z,
                 xy * normal.x + 0.5 * (even - odd) * normal.y + yz * normal.z, xz * normal.x + yz * normal.y + zz * normal.z);
  vec3 from = 0.1875 * d + 0.5 * tn + 0.1875 * dot(normal, d) * normal;
  float size = length(from);
  vec3 facing = size > 1e-6 ? -from / size : -normal;
  return Bounce(max(irradiance_here, vec3(0.0)) * (left / kShPi), facing, 0.5 + 0.5 * clamp(size / max(all, 1e-6), 0.0, 1.0));
}

// The light to add to the irradiance. `there` and `behind`: the irradiance map in the direction `facing` and opposite to it.
vec3 bounced(Bounce bounce, vec3 there, vec3 behind) { return bounce.share * mix(behind, there, bounce.sure); }

#endif
