// Windows of the sun's map around what is near the eye, each a quarter as wide as the one before. They keep their size and move by whole
// texels, so shadows do not crawl: Valient, "Stable rendering of cascaded shadow maps", ShaderX6, 2008.
// read    sun?          see scene/sun.glsl; without it the environment's brightest spot is the sun:
//         brightest     `as uniform`, see ibl/brightest.glsl
//         scene_bounds  see shadow/scene_bounds.glsl
// write   sun_windows   Sun[]: its map is the window
// params  eye, ahead    where it is, and the unit direction in which it looks; about is enough
//         sky_turn?     without sun: rotation of the environment, in full turns
#ifdef HAS_SUN
#include "scene/sun.glsl"
#else
#include "ibl/brightest.glsl"
#include "scene/sun_row.glsl"
#include "shadow/scene_bounds.glsl"
#endif
layout(local_size_x = 4) in;

layout(std430) writeonly buffer sun_windows { Sun sun_window[]; };
layout(std140) uniform Parameters {
  vec3 eye;
  vec3 ahead;
#ifdef HAS_SKY_TURN
  float sky_turn;
#endif
};
#ifndef HAS_SKY_TURN
const float sky_turn = 0.0;
#endif

#ifdef HAS_SUN
Sun brightestSun() { return sun_light[0]; }
#else
Sun brightestSun() {
  vec3 towards = towardsSpot(0, sky_turn);
  MapRows map = mapFrom(towards);
  return Sun(towards, cos(min(spotIrradiance(0).w, 0.5)), vec3(0.0), bounds_row[0].texel,
             transpose(mat4(map.u, map.v, map.depth, vec4(0.0, 0.0, 0.0, 1.0))));
}
#endif

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= sun_window.length()) return;
  Sun self = brightestSun();
  mat4 whole = self.shadow_matrix;
  float per_unit = length(vec3(whole[0].x, whole[1].x, whole[2].x));
  // Wide enough for the penumbra of what is an eighth of the whole away: see kWidest in shading/mesh_shadow.glsl.
  float spread = sqrt(1.0 - self.cos_angle * self.cos_angle) / max(self.cos_angle, 1e-3);
  float part = clamp(1.25 * spread, pow(0.25, float(i + 1)), 1.0);
  self.texel *= part;
  float texel = self.texel * per_unit;
  vec2 center = (whole * vec4(eye + ahead * (0.3 * part / per_unit), 1.0)).xy;
  vec2 corner = round((center - 0.5 * part) / texel) * texel;
  for (int column = 0; column < 4; ++column) whole[column].xy /= part;
  whole[3].xy -= corner / part;
  self.shadow_matrix = whole;
  sun_window[i] = self;
}
