// Visibility of the sun and of the environment's brightest spots, by the shadow maps of graphs/mesh_shadows.json, of reversed-Z depth.
// read    light_maps    `as compare`, an array: of the sun if there is one, of the first spot, of the others
//         light_depths  the same as numbers
//         scene_bounds  see shadow/scene_bounds.glsl
//         sun_windows?  see shadow/sun_windows.comp.glsl, of the sun or else of the first spot: their maps are the last of light_maps
//         sun?, brightest?   see scene/sun.glsl, ibl/brightest.glsl; included before, as is sky_turn
// Penumbrae grow with the distance from what casts them: percentage-closer soft shadows, Fernando, SIGGRAPH 2005 sketches. A sample beside
// the point is compared with the receiver's plane there, so planes do not shadow themselves. A point may lie beyond depth 0 of the map.
#ifndef SHADING_MESH_SHADOW_GLSL
#define SHADING_MESH_SHADOW_GLSL

#include "ibl/brightest.glsl"
#include "scene/sun_row.glsl"
#include "shading/point.glsl"
#include "shadow/rows.glsl"
#include "shadow/scene_bounds.glsl"
#ifdef HAS_SUN
#include "scene/sun.glsl"
#endif
#ifdef HAS_SUN_WINDOWS
layout(std430) readonly buffer sun_windows { Sun sun_window[]; };
#endif

uniform sampler2DArrayShadow light_maps;
uniform sampler2DArray light_depths;

float light_layer = 0.0;
// At u, v and depth: 1 in the shadow, 0 in the light, and between.
float shadowHides(vec3 at) { return 1.0 - texture(light_maps, vec4(at.xy, light_layer, at.z)); }
float shadowDepth(vec2 at) { return textureLod(light_depths, vec3(at, light_layer), 0.0).r; }

struct ShadowedLight {
  vec3 direction;  // unit, towards it
  float spread;    // tangent of half its angular size
  float texel;     // world units
  vec3 part;       // of the map: its corner and its size
  MapRows map;
};

ShadowedLight shadowedSun(Sun self) {
  float spread = sqrt(max(1.0 - self.cos_angle * self.cos_angle, 0.0)) / max(self.cos_angle, 1e-3);
  vec4 x = self.shadow_matrix[0], y = self.shadow_matrix[1], z = self.shadow_matrix[2], origin = self.shadow_matrix[3];
  MapRows map = MapRows(vec4(x.x, y.x, z.x, origin.x), vec4(x.y, y.y, z.y, origin.y), vec4(x.z, y.z, z.z, origin.z));
  return ShadowedLight(self.direction, spread, self.texel, vec3(0.0, 0.0, 1.0), map);
}

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
  vec2 texel = 1.0 / vec2(textureSize(light_maps, 0).xy);
  vec2 steepest = 20.0 * self.texel * per_depth / texel;
  vec2 slope = clamp(-facing.xy / max(facing.z, 1e-9), -steepest, steepest);
  float bias = 0.5 * self.texel * per_depth;

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
}

// Unit `n`. One loop over all lights, so that the program has the filter once.
LightsSeen lightsPastMeshes(vec3 position, vec3 n, float turn) {
  LightsSeen seen = kOpen;
#ifdef HAS_SUN
  const int first = 0;
#else
  const int first = 1;
#endif
  for (int i = first; i <= spot_count; ++i) {
    int row = max(i - 1, 0);
    vec3 spot = towardsSpot(row, turn), part = partOfSpot(row);
    ShadowedLight self = ShadowedLight(spot, tan(min(spotIrradiance(row).w, 0.5)), bounds_row[0].texel / part.z, part,
                                       inPart(mapFrom(spot), part));
    light_layer = float(min(i, 2) - first);
#ifdef HAS_SUN
    if (i == 0) self = shadowedSun(sun_light[0]);
#endif
#ifdef HAS_SUN_WINDOWS
    // The finest window that holds all that the widest penumbra is made of.
    for (int w = 0; w < (i == first ? sun_window.length() : 0); ++w) {
      ShadowedLight finer = shadowedSun(sun_window[w]);
      vec2 off = abs(onMap(finer.map, position).xy - 0.5);
      if (max(off.x, off.y) < 0.49 - kWidest) {
        self = finer;
        light_layer = float(textureSize(light_maps, 0).z - sun_window.length() + w);
      }
    }
#endif
    float open = 1.0;
    if (dot(n, self.direction) > 0.0) open = seenInMap(self, position, n);
    if (i == 0) seen.sun = open;
    if (i == 1) seen.spot = open;
    if (i > 1) seen.others -= onlySpot(row).yzw * (1.0 - open);
  }
  return seen;
}

#endif
