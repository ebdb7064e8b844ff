// Share of the sun that a point sees; moved off its surface by a texel of the map, or it would shade itself.
#include "scene/sun.glsl"

uniform sampler2DShadow sun_map;

float sunSeen(vec3 position, vec3 n) {
  vec3 at = (sun_light[0].shadow_matrix * vec4(position + 2.0 * sun_light[0].texel * n, 1.0)).xyz;
  float sum = 0.0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) sum += texture(sun_map, vec3(at.xy + vec2(x, y) / vec2(textureSize(sun_map, 0)), at.z));
  return sum / 9.0;
}
