// Visibility of a light far away from a point, by a shadow map of reversed-Z depth. The includer defines how the map is read, before:
//   vec2 shadowSize()             of the map, texels
//   float shadowHides(vec3 at)    u, v and depth: 1 in the shadow, 0 in the light, and between
//   float shadowDepth(vec2 at)    with SOFT_SUN
// SOFT_SUN: penumbrae grow with the distance from what casts them: percentage-closer soft shadows, Fernando, SIGGRAPH 2005 sketches.
// A sample beside the point is compared with the receiver's plane there, so planes do not shadow themselves. A point may lie beyond depth 0
// of the map.
#ifndef SHADING_SOFT_SHADOW_GLSL
#define SHADING_SOFT_SHADOW_GLSL

#ifndef SOFT_SUN
#define SOFT_SUN 0
#endif

#include "shadow/rows.glsl"

struct ShadowedLight {
  vec3 direction;  // unit, towards it
  float spread;    // tangent of half its angular size
  float texel;     // world units
  vec3 part;       // of the map: its corner and its size
  MapRows map;
};

#ifdef HAS_SUN
ShadowedLight shadowedSun(Sun self) {
  float spread = sqrt(max(1.0 - self.cos_angle * self.cos_angle, 0.0)) / max(self.cos_angle, 1e-3);
  vec4 x = self.shadow_matrix[0], y = self.shadow_matrix[1], z = self.shadow_matrix[2], origin = self.shadow_matrix[3];
  MapRows map = MapRows(vec4(x.x, y.x, z.x, origin.x), vec4(x.y, y.y, z.y, origin.y), vec4(x.z, y.z, z.z, origin.z));
  return ShadowedLight(self.direction, spread, self.texel, vec3(0.0, 0.0, 1.0), map);
}
#endif

const int kBlockers = 16, kFilter = 32;  // samples of the search and of the filter
const float kWidest = 0.1;               // share of its part of the map that a penumbra may take
const float kNothing = 1e-6;             // the least depth of anything; the map is cleared to 0

// Points spread evenly over the unit disc (Vogel 1979), turned per pixel.
vec2 onDisc(int i, int count, float turn) {
  float angle = 2.39996323 * float(i) + turn;
  return sqrt((float(i) + 0.5) / float(count)) * vec2(cos(angle), sin(angle));
}

float seenInMap(ShadowedLight self, vec3 position, vec3 n) {
  float nl = dot(n, self.direction), slant = sqrt(max(1.0 - nl * nl, 0.0));
  vec3 at = onMap(self.map, position + n * (self.texel * (0.25 + 1.75 * slant)));
  vec2 corner = self.part.xy, widest = vec2(kWidest * self.part.z);
  if (any(lessThan(at.xy, corner)) || any(greaterThan(at, vec3(corner + self.part.z, 1.0)))) return 1.0;

  // Slope of the receiver's plane in the map: its normal there is that in the world times the inverse transpose.
  vec3 u = self.map.u.xyz, v = self.map.v.xyz, z = self.map.depth.xyz;
  vec3 facing = vec3(dot(u, n) / dot(u, u), dot(v, n) / dot(v, v), dot(z, n) / dot(z, z));
  float per_depth = length(z);  // depth per world unit
  vec2 texel = 1.0 / shadowSize();
  vec2 steepest = 20.0 * self.texel * per_depth / texel;
  vec2 slope = clamp(-facing.xy / max(facing.z, 1e-9), -steepest, steepest);
  float bias = 0.5 * self.texel * per_depth;

#if SOFT_SUN
  float turn = 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  vec2 per_unit = vec2(length(u), length(v));
  vec2 search = clamp(self.spread * (1.0 - at.z) / per_depth * per_unit, 2.0 * texel, widest);
  float blockers = 0.0, depths = 0.0;
  for (int i = 0; i < kBlockers; ++i) {
    // Denser towards the middle, to find small near blockers too.
    vec2 offset = onDisc(i, kBlockers, turn) * search * ((float(i) + 0.5) / float(kBlockers));
    float there = shadowDepth(at.xy + offset), plane = at.z + dot(slope, offset);
    if (there <= 0.0 || there <= plane + bias + 0.5 * dot(abs(slope), texel)) continue;
    blockers += 1.0;
    depths += there - plane;
  }
  // Where the search found no blocker, one that hides the point itself is small, and so is its penumbra.
  if (blockers == 0.0 && shadowHides(vec3(at.xy, max(at.z + bias, kNothing))) == 0.0) return 1.0;
  vec2 width = clamp(self.spread * depths / max(blockers, 1.0) / per_depth * per_unit, texel, widest);
  float hidden = 0.0;
  for (int i = 0; i < kFilter; ++i) {
    vec2 offset = onDisc(i, kFilter, turn) * width;
    hidden += shadowHides(vec3(at.xy + offset, max(at.z + dot(slope, offset) + bias, kNothing)));
  }
  return 1.0 - hidden / float(kFilter);
#else
  float hidden = 0.0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      vec2 offset = vec2(x, y) * texel;
      hidden += shadowHides(vec3(at.xy + offset, max(at.z + dot(slope, offset) + bias, kNothing)));
    }
  return 1.0 - hidden / 9.0;
#endif
}

#endif
