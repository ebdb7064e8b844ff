// Matte, lit by the sun with its shadow, and a little by the sky.
// read    sun        the import @sun
// read    sun_map    how near to the sun things are, as compare
// modify  radiance   scene-referred, linear
#include "scene/sun.glsl"

uniform sampler2DShadow sun_map;
in vec3 world, facing;
flat in vec3 color;
out vec4 radiance;

void main() {
  Sun light = sun_light[0];
  vec3 n = normalize(facing);
  float slope = max(dot(n, light.direction), 0.0);
  // A little towards the light, so that a surface is not in its own shadow.
  vec3 at = (light.shadow_matrix * vec4(world + n * 2.0 * light.texel, 1.0)).xyz;
  float lit = slope * texture(sun_map, at);
  radiance = vec4(color * (lit * light.irradiance / 3.14159 + vec3(0.15, 0.2, 0.3)), 1.0);
}
