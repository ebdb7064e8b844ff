// What surrounds points spread evenly over a sphere, by the pixel.
// read   neighbors, irradiance, brdf, sun?; spheres
// write  shares (of the sky, the mirrored lobe and the sun that are seen), around (light from everywhere), place, facing (normal)
// params row, roughness
#include "common/view.glsl"
layout(std140) uniform Parameters {
  int row;
  float roughness;
};
#include "shading/ambient.glsl"
#include "shading/lobe.glsl"
#include "spheres/neighbors/irradiance.glsl"

struct Instance {
  vec3 center;
  float radius;
};
layout(std430) readonly buffer spheres { Instance instance[]; };

out vec4 shares;
out vec4 around;
out vec4 place;
out vec4 facing;

void main() {
  vec2 at = gl_FragCoord.xy / 64.0;
  float z = at.y * 2.0 - 1.0;
  vec3 n = vec3(sqrt(1.0 - z * z) * vec2(cos(2.0 * kPi * at.x), sin(2.0 * kPi * at.x)), z);
  vec3 position = instance[row].center + n * instance[row].radius;
  vec3 v = normalize(eye - position);
  Surface surface = Surface(vec3(1.0), 1.0, roughness);
  Point point = Point(position, n, v, reflect(-v, n), clamp(dot(n, v), 0.0, 1.0), 1.0);
  Lobe lobe = lobeOf(roughness, 0.0);
  vec3 axis = mix(point.mirror, n, responseOf(surface, point.nv).lean);
  Occlusion all = occlusionOf(listOf(uint(row)), point, surface, axis, lobe);
  shares = vec4(all.sky.seen, all.lobe.seen, all.lights.sun, 1.0);
  vec4 below = irradianceTowards(irradiance, vec3(0.0, -1.0, 0.0), lobe);
  vec4 sky = vec4(irradianceTowards(irradiance, all.sky.bent, lobe).rgb, 0.0);
  around = vec4(irradianceSeen(all.sky, n, lobe, sky, all.lights.spot, below.rgb), 1.0);
  place = vec4(position, 1.0);
  facing = vec4(n, 0.0);
}
