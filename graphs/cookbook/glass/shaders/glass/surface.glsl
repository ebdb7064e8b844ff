// A thin colored shell. rgb: what it reflects and glows, times a; a: opacity, which grows towards the rim (Schlick 1994).
#include "common/view.glsl"
#include "sky_at.glsl"

in vec3 world, facing;
flat in vec3 color;
layout(std140) uniform Parameters { float opacity; };

vec4 shell() {
  vec3 n = normalize(facing), to_eye = towardsEye(world);
  if (dot(n, to_eye) < 0.0) n = -n;
  float rim = 0.04 + 0.96 * pow(1.0 - max(dot(n, to_eye), 0.0), 5.0);
  float a = opacity + (1.0 - opacity) * rim;
  return vec4(opacity * (1.0 - rim) * color * 0.9 + rim * skyAt(reflect(-to_eye, n)), a);
}
