// Visibility of the sky on the ground past a sphere, in closed form, with the light that the sphere reflects: light bounces between the
// two. Both see about the same share of the sky, so that ground = seen + hidden albedo sphere, sphere = seen + hidden ground_albedo ground.
// modify  sky   "multiply"
#include "spheres/neighbors/caps.glsl"

in vec3 to_center;
flat in vec2 window;
flat in vec3 albedo;
flat in vec3 shared_albedo;
flat in int cut;
out vec4 sky;

void main() {
  float distance2 = max(dot(to_center, to_center), 1.0), per_distance = inversesqrt(distance2);
  float share = to_center.y * per_distance / distance2;
  // A sphere that intersects the ground costs three times as much. A loop, because in software all pixels run both branches of a condition.
  for (int i = 0; i < cut; ++i) share = capShare(distance2 * per_distance, to_center.y * per_distance);
  float ending = clamp(distance2 * per_distance * window.x + window.y, 0.0, 1.0);  // as withinReach has it
  float hidden = min(share * (1.0 - ending * ending * (3.0 - 2.0 * ending)), 1.0), seen = 1.0 - hidden;
  sky = vec4((seen + seen * hidden * albedo) / (1.0 - hidden * hidden * shared_albedo), 1.0);
}
