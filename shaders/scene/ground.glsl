// The plane that the scene stands on, the import @ground under the slot `ground`.
#ifndef SCENE_GROUND_GLSL
#define SCENE_GROUND_GLSL

struct Ground {
  float height;  // world Y
  vec3 albedo;   // linear, of its surface
  float radius;  // of its surface, about the world's Y axis; 0: it shows the environment
};
layout(std430) readonly buffer ground { Ground ground_row[]; };

// Where the environment shows the ground, an estimate: about that of gravel or dry grass.
vec3 groundAlbedo(Ground self) { return self.radius > 0.0 ? self.albedo : vec3(0.25); }

#endif
