// Position of a vertex in the shadow map of one of the environment's brightest spots, outside of it where there is no such spot, or in a
// window of the sun's; without both, in the pass's view.
// read    brightest?   `as uniform`, see ibl/brightest.glsl; with it scene_bounds, see shadow/scene_bounds.glsl
//         sun?   windows, see shadow/sun_windows.comp.glsl
// params  sky_turn, spot   with brightest: rotation of the environment, in full turns; which spot
//         window         with sun: which
#ifndef SHADOW_FROM_SPOT_GLSL
#define SHADOW_FROM_SPOT_GLSL

#include "common/view.glsl"
#if defined HAS_BRIGHTEST && defined HAS_SCENE_BOUNDS
#include "ibl/brightest.glsl"
#include "shadow/scene_bounds.glsl"

layout(std140) uniform Parameters {
  float sky_turn;
  int spot;
};

vec4 lightClip(vec3 at) {
  vec3 map = onMap(inPart(mapFrom(towardsSpot(spot, sky_turn)), partOfSpot(spot)), at);
  return spot < spot_count ? vec4(map.xy * 2.0 - 1.0, map.z, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
#elif defined HAS_SUN
#include "scene/sun.glsl"
layout(std140) uniform Parameters { int window; };

vec4 lightClip(vec3 at) {
  vec3 map = (sun_light[window].shadow_matrix * vec4(at, 1.0)).xyz;
  return vec4(map.xy * 2.0 - 1.0, map.z, 1.0);
}
#else
vec4 lightClip(vec3 at) { return view_projection * vec4(at, 1.0); }
#endif

#endif
