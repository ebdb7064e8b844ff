// The visible share of the disc of a distant light past a sphere, as seen from the ground: two circles in a flat sky.
// modify  seen     with SPOTS a channel for each of the brightest spots; "multiply"
#include "common/fast_atan.glsl"
#include "spheres/neighbors/overlap.glsl"

in vec3 at;
flat in vec4 sphere;
flat in vec4 light;
flat in int spot;
out vec4 seen;

void main() {
  vec3 to = sphere.xyz - at;
  float distance_to = length(to), sine = min(sphere.w / distance_to, 1.0);
  // The angle between the two, and half the angular size of the sphere.
  vec2 angles = fastAtan(vec2(length(cross(to, light.xyz)), sine), vec2(dot(to, light.xyz), sqrt(1.0 - sine * sine)));
  seen = 1.0 - vec4(equal(ivec4(0, 1, 2, 3), ivec4(spot))) * discOverlap(angles.y, light.w, angles.x);
}
