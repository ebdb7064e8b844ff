// How much of the sun a point sees, from a shadow map of reversed-Z depth, larger nearer to the sun.
// Slots: sun_map `as compare`, see shading/compare.glsl
//        sun_depth?  the same texture as numbers; with it (SOFT_SUN) penumbrae grow with the distance from what casts them: percentage-closer
//                    soft shadows, Fernando, SIGGRAPH 2005 sketches, with a sun of its angle
// A sample beside the point is compared with where the receiver's plane is there, so planes do not shadow themselves.
#ifndef SHADING_SUN_SHADOW_GLSL
#define SHADING_SUN_SHADOW_GLSL

#include "scene/sun.glsl"
#include "shading/compare.glsl"

#ifndef SOFT_SUN
#define SOFT_SUN 0
#endif

uniform sampler2DShadow sun_map;
#if SOFT_SUN
uniform sampler2D sun_depth;
#endif

const int kBlockers = 16, kFilter = 32;  // samples of the search and of the filter
const float kWidest = 0.1;               // share of the map that a penumbra may take

// Points spread evenly over the unit disc (Vogel 1979), turned per pixel.
vec2 onDisc(int i, int count, float turn) {
  float angle = 2.39996323 * float(i) + turn;
  return sqrt((float(i) + 0.5) / float(count)) * vec2(cos(angle), sin(angle));
}

float seenOfSun(Sun self, vec3 position, vec3 n) {
  float nl = dot(n, self.direction), slant = sqrt(max(1.0 - nl * nl, 0.0));
  vec3 at = (self.shadow_matrix * vec4(position + n * (self.texel * (0.25 + 1.75 * slant)), 1.0)).xyz;
  if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0)))) return 1.0;

  // Slope of the receiver's plane in the map: its normal there is that in the world times the inverse transpose.
  mat3 rows = transpose(mat3(self.shadow_matrix));
  vec3 u = rows[0], v = rows[1], z = rows[2];
  vec3 facing = vec3(dot(u, n) / dot(u, u), dot(v, n) / dot(v, v), dot(z, n) / dot(z, z));
  float per_depth = length(z);  // depth per world unit
  vec2 texel = 1.0 / vec2(textureSize(sun_map, 0));
  vec2 steepest = 20.0 * self.texel * per_depth / texel;
  vec2 slope = clamp(-facing.xy / max(facing.z, 1e-9), -steepest, steepest);
  float bias = 0.5 * self.texel * per_depth;

#if SOFT_SUN
  float turn = 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  float spread = sqrt(max(1.0 - self.cos_angle * self.cos_angle, 0.0)) / max(self.cos_angle, 1e-3);  // radius at distance 1
  vec2 per_unit = vec2(length(u), length(v));
  vec2 search = clamp(spread * (1.0 - at.z) / per_depth * per_unit, 2.0 * texel, vec2(kWidest));
  float blockers = 0.0, depths = 0.0;
  for (int i = 0; i < kBlockers; ++i) {
    vec2 offset = onDisc(i, kBlockers, turn) * search;
    float there = textureLod(sun_depth, at.xy + offset, 0.0).r, plane = at.z + dot(slope, offset);
    if (there <= plane + bias + 0.5 * dot(abs(slope), texel)) continue;
    blockers += 1.0;
    depths += there - plane;
  }
  if (blockers == 0.0) return 1.0;
  vec2 width = clamp(spread * depths / blockers / per_depth * per_unit, texel, vec2(kWidest));
  float hidden = 0.0;
  for (int i = 0; i < kFilter; ++i) {
    vec2 offset = onDisc(i, kFilter, turn) * width;
    hidden += hiddenBy(texture(sun_map, vec3(at.xy + offset, at.z + dot(slope, offset) + bias)));
  }
  return 1.0 - hidden / float(kFilter);
#else
  float hidden = 0.0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      vec2 offset = vec2(x, y) * texel;
      hidden += hiddenBy(texture(sun_map, vec3(at.xy + offset, at.z + dot(slope, offset) + bias)));
    }
  return 1.0 - hidden / 9.0;
#endif
}

#endif
