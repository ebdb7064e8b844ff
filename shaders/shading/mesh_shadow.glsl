// Visibility of the sun and of the environment's brightest spots, by the shadow maps of graphs/mesh_shadows.json, see
// shading/soft_shadow.glsl.
// read    light_maps    `as compare`, an array: layer 0 of the sun, 1 of the first spot, 2 of the others
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
    light_layer = float(min(i, 2));
#ifdef HAS_SUN
    if (i == 0) {
      self = shadowedSun(sun_light[0]);
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
