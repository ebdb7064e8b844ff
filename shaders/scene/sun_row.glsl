// A row of the import @sun.
#ifndef SCENE_SUN_ROW_GLSL
#define SCENE_SUN_ROW_GLSL

struct Sun {
  vec3 direction;      // unit, towards the sun
  float cos_angle;     // of half its angular size
  vec3 irradiance;     // on a surface that faces it, scene-referred
  float texel;         // world units that a texel of the shadow map is wide
  mat4 shadow_matrix;  // world to texture coordinates and reversed-Z depth, all 0..1; a rotation and a scale
};

#endif
