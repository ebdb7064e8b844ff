// Visibility of the sun and of the environment's brightest spot, by the shadow maps of graphs/mesh_shadows.json, see
// shading/soft_shadow.glsl.
// read    light_maps    `as compare`, an array: layer 0 of the sun, 1 of the spot
//         light_depths  the same as numbers
//         scene_bounds  see shadow/scene_bounds.glsl
//         sun?, brightest?   see scene/sun.glsl, ibl/brightest.glsl; included before, as is sky_turn
#ifndef SHADING_MESH_SHADOW_GLSL
#define SHADING_MESH_SHADOW_GLSL

#define SOFT_SUN 1
#include "ibl/brightest.glsl"
#include "shading/point.glsl"
#include "shadow/scene_bounds.glsl"
#ifdef HAS_SUN
#include "scene/sun.glsl"
#endif

uniform sampler2DArrayShadow light_maps;
uniform sampler2DArray light_depths;

float light_layer = 0.0;
vec2 shadowSize() { return vec2(textureSize(light_maps, 0).xy); }
float shadowHides(vec3 at) { return 1.0 - texture(light_maps, vec4(at.xy, light_layer, at.z)); }
float shadowDepth(vec2 at) { return textureLod(light_depths, vec3(at, light_layer), 0.0).r; }
#include "shading/soft_shadow.glsl"

// Unit `n`. One loop over both lights, so that the program has the filter once.
LightsSeen lightsPastMeshes(vec3 position, vec3 n, float turn) {
  vec2 seen = vec2(1.0);
#ifdef HAS_SUN
  const int first = 0;
#else
  const int first = 1;
#endif
#ifdef HAS_BRIGHTEST
  const int last = 1;
#else
  const int last = 0;
#endif
  for (int i = first; i <= last; ++i) {
    vec3 spot = towardsBrightest(turn);
    ShadowedLight self = ShadowedLight(spot, tan(min(spotIrradiance().w, 0.5)), bounds_row[0].texel, mapFrom(spot));
    light_layer = float(i);
#ifdef HAS_SUN
    if (i == 0) {
      self = shadowedSun(sun_light[0]);
    }
#endif
    bool shines = i == 0 || brightest_light.r + brightest_light.g + brightest_light.b > 0.0;
    if (shines && dot(n, self.direction) > 0.0) seen[i] = seenInMap(self, position, n);
  }
  return LightsSeen(seen.x, seen.y);
}

#endif
