// Irradiance of a surface somewhere in the probes' box or a fifth of it outside, by the pixel.
// read  probes, sh?   write  light, place (where the surface is), facing (its normal), from (bounce.facing and bounce.sure)
#include "gi/bounce.glsl"
out vec4 light;
out vec4 place;
out vec4 facing;
out vec4 from;

vec3 noise(uvec3 v) {  // pcg3d, Jarzynski and Olano, JCGT 2020
  v = v * 1664525u + 1013904223u;
  v += v.yzx * v.zxy;
  v ^= v >> 16u;
  v += v.yzx * v.zxy;
  return vec3(v >> 8u) / 16777216.0;
}

void main() {
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  vec3 extent = probes_high.xyz - probes_low.xyz;
  vec3 at = probes_low.xyz + extent * (noise(uvec3(pixel, 0u)) * 1.4 - 0.2);
  vec3 turn = noise(uvec3(pixel, 1u));
  float z = turn.x * 2.0 - 1.0, phi = turn.y * 6.2831853;
  vec3 normal = normalize(vec3(sqrt(max(1.0 - z * z, 0.0)) * vec2(cos(phi), sin(phi)), z));
  place = vec4(at, 1.0);
  facing = vec4(normal, 0.0);
  vec3 c[9];
  float left = probeAt(at, c);
  light = vec4(left * probeIrradiance(c, normal), 1.0);
  Bounce bounce = bounceOf(c, left, normal);
  from = vec4(bounce.facing, bounce.sure);
}
