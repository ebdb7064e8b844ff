// The rows of a draw list, filled by the engine (bound by the name of the block).
#ifndef SCENE_INSTANCES_GLSL
#define SCENE_INSTANCES_GLSL

struct Instance {
  vec3 center;            // world
  float radius;
  vec3 previous_center;
  float roughness;        // perceptual
  vec3 albedo;            // linear; F0 of a metal
  float metallic;
};
layout(std430) readonly buffer instances { Instance instance[]; };

#endif
