// Visibility of the sun from a point, by a shadow map, see shading/soft_shadow.glsl.
// Slots: sun_map `as compare`, by which 1 is lit
//        sun_depth?  the same texture as numbers; with it (SOFT_SUN) a sun of its angle
#ifndef SHADING_SUN_SHADOW_GLSL
#define SHADING_SUN_SHADOW_GLSL

#include "scene/sun.glsl"

#ifndef SOFT_SUN
#define SOFT_SUN 0
#endif

uniform sampler2DShadow sun_map;
#if SOFT_SUN
uniform sampler2D sun_depth;
float shadowDepth(vec2 at) { return textureLod(sun_depth, at, 0.0).r; }
#endif
vec2 shadowSize() { return vec2(textureSize(sun_map, 0)); }
float shadowHides(vec3 at) { return 1.0 - texture(sun_map, at); }
#include "shading/soft_shadow.glsl"

#endif
