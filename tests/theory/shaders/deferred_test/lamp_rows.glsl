// Rows as scene/lamps.glsl reads them, for a shader that makes lamps.
#ifndef DEFERRED_TEST_LAMP_ROWS_GLSL
#define DEFERRED_TEST_LAMP_ROWS_GLSL

struct Lamp {
  vec3 position;
  float range;
  vec3 intensity;
  float cos_inner;
  vec3 direction;
  float cos_outer;
  float near_plane;
  int shadow;
};
layout(std430) writeonly buffer lamps { Lamp lamp[]; };

#endif
