// What a sphere leaves of the disc of a light far away, as the ground sees it: two circles, as if the sky were flat there.
// modify  lights   x: of the sun; with SPOT y: of the brightest spot; "multiply"
#include "neighbours/overlap.glsl"

in vec3 at;
flat in vec4 sphere;
flat in vec4 light;
out vec2 lights;

void main() {
  vec3 to = sphere.xyz - at;
  float distance_to = length(to), sine = min(sphere.w / distance_to, 1.0);
  float apart = fastAtan(length(cross(to, light.xyz)), dot(to, light.xyz));
  float seen = 1.0 - discOverlap(fastAtan(sine, sqrt(1.0 - sine * sine)), light.w, apart);
  lights = SPOT == 1 ? vec2(1.0, seen) : vec2(seen, 1.0);
}
