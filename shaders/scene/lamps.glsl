// Point and spot lights, the import @lamps under the slot `lamps`. Beyond `range` and outside its cone a lamp gives exactly 0.
#ifndef SCENE_LAMPS_GLSL
#define SCENE_LAMPS_GLSL

struct Lamp {
  vec3 position;    // world
  float range;      // world units
  vec3 intensity;   // radiant intensity, scene-referred: irradiance at distance 1
  float cos_inner;  // within this angle of `direction`, full intensity
  vec3 direction;   // of the spot's axis, away from the lamp
  float cos_outer;  // -1: all round
  float near_plane; // of its shadow map
  int shadow;       // which cube of the shadow maps; -1: casts none
#ifdef HAS_LTC
  vec3 across, up;  // of a rectangle, from its middle to two of its sides; 0: it is none
#endif
};
layout(std430) readonly buffer lamps { Lamp lamp[]; };

// Irradiance on a surface at `position` that faces the lamp; `towards` is the unit direction to it. The inverse square with the window of
// glTF's KHR_lights_punctual, and its cone.
vec3 lampIrradiance(Lamp self, vec3 position, out vec3 towards) {
  vec3 to = self.position - position;
  float distance2 = max(dot(to, to), 1e-8), far2 = distance2 / (self.range * self.range);
  towards = to * inversesqrt(distance2);
  float window = clamp(1.0 - far2 * far2, 0.0, 1.0) / max(distance2, 1e-4);
  if (self.cos_outer > -1.0) {
    float cone = clamp((-dot(towards, self.direction) - self.cos_outer) / max(self.cos_inner - self.cos_outer, 1e-4), 0.0, 1.0);
    window *= cone * cone;
  }
  return self.intensity * window;
}

// A bounding sphere of everything that the lamp lights.
vec4 lampBounds(Lamp self) {
  if (self.cos_outer <= 0.0) return vec4(self.position, self.range);
  // A spot lights a cone with a round end. Its sphere goes through apex and rim, or around the rim when the cone is wide (Wronski,
  // "Cull that cone", 2017).
  float outer = self.cos_outer;
  if (outer > 0.70710678) return vec4(self.position + self.direction * (0.5 * self.range / outer), 0.5 * self.range / outer);
  return vec4(self.position + self.direction * (self.range * outer), self.range * sqrt(1.0 - outer * outer));
}

#endif
