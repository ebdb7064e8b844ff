// What a sphere leaves of the sky's light on the ground, in closed form, and what it throws back of it: light goes to and fro between the
// two. Both see about as much of the sky, so that ground = seen + hidden albedo sphere, sphere = seen + hidden ground_albedo ground.
// modify  sky   "multiply"
#include "neighbours/caps.glsl"
#include "scene/ground.glsl"

in vec3 at;
flat in vec4 sphere;
flat in vec4 albedo_reach;
out vec4 sky;

void main() {
  vec3 to = sphere.xyz - at;
  float distance_to = length(to), ratio = max(distance_to / sphere.w, 1.0);
  float hidden = min(capShare(ratio, to.y / distance_to) * withinReach(ratio, albedo_reach.w), 1.0), seen = 1.0 - hidden;
  vec3 own = groundAlbedo(ground_row[0]);
  sky = vec4(seen * (1.0 + hidden * albedo_reach.rgb) / (1.0 - hidden * hidden * albedo_reach.rgb * own), 1.0);
}
