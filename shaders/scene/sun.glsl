// The sun, the import @sun under the slot `sun`: light from one direction, and where its shadow map lies in the world.
#ifndef SCENE_SUN_GLSL
#define SCENE_SUN_GLSL

#include "scene/sun_row.glsl"

layout(std430) readonly buffer sun { Sun sun_light[]; };

#endif
