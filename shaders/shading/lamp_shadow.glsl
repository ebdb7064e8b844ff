// Visibility of a lamp from a point, by a cube map of reversed-Z depth per lamp: near_plane / distance along the face's axis.
// Slot: lamp_maps `as compare`, a cube array, by which 1 is lit.
// Five linear lookups, one texel apart. The point is moved along the normal, by more than its plane changes over them.
#ifndef SHADING_LAMP_SHADOW_GLSL
#define SHADING_LAMP_SHADOW_GLSL

#include "common/cube.glsl"
#include "scene/lamps.glsl"

uniform samplerCubeArrayShadow lamp_maps;

float seenOfLamp(Lamp self, vec3 position, vec3 n) {
  vec3 from = position - self.position;
  float texel = 2.0 / float(textureSize(lamp_maps, 0).x), along = dot(from, n), away = length(from);
  float slant = sqrt(max(1.0 - along * along / (away * away), 0.0));
  texel *= axisOf(from);
  from += n * (texel * (1.5 + 1.5 * slant));
  vec3 side = normalize(abs(from.y) < 0.7 * away ? cross(from, vec3(0.0, 1.0, 0.0)) : cross(from, vec3(1.0, 0.0, 0.0)));
  vec3 up = normalize(cross(side, from));
  float hidden = 0.0;
  for (int i = 0; i < 5; ++i) {
    vec3 beside = (i & 1) == 0 ? side : up;  // side, up, and opposite to them
    vec3 to = from + (i == 4 ? vec3(0.0) : texel * (i < 2 ? beside : -beside));
    hidden += 1.0 - texture(lamp_maps, vec4(to, float(self.shadow)), self.near_plane / axisOf(to) * (1.0 + 1e-4));
  }
  return 1.0 - 0.2 * hidden;
}

#endif
