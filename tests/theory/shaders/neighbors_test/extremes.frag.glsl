// What the ground gets where spheres hide all of its sky and more, by the pixel: along x the share that they hide, an eighth a pixel; along y the
// albedo of the spheres and of the ground, up to 1.
// read   neighbors, brdf
// write  on_ground (the sky's light; then what a sphere hides whose center is four radii above, at x = 0 no radius above)
#include "common/view.glsl"
#include "spheres/neighbors/ground_light.glsl"

out vec4 on_ground;

void main() {
  vec2 at = floor(gl_FragCoord.xy);
  float share = at.x / 8.0, albedo = at.y / 63.0;
  GroundPlane plane = GroundPlane(1.0, 0.0, 1e5, vec3(albedo));
  on_ground = vec4(skyOnGround(plane, vec4(vec3(albedo), 1.0) * share).r, capOnGround(vec3(0.0, share, 0.0), 0.25 * share), 0.0, 1.0);
}
