// What surrounds points spread evenly over a sphere, by the pixel.
// read   neighbours, irradiance, brdf, sun?; spheres
// write  shares (of the sky, the mirrored lobe and the sun that are seen), around (light from everywhere), place, facing (normal)
// params row, roughness
#include "common/view.glsl"
layout(std140) uniform Parameters {
  int row;
  float roughness;
};
#include "neighbours/surround.glsl"

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
  Lobe lobe = lobeOf(roughness, 0.0);
  float lean = responseOf(Surface(vec3(1.0), 1.0, roughness), clamp(dot(n, v), 0.0, 1.0)).lobe.x;
  Surround all = surroundOf(listedOf(uint(row)), position, n, mix(reflect(-v, n), n, lean), roughness, vec3(1.0), lobe);
  shares = vec4(all.seen, all.mirror_seen, all.sun_seen, 1.0);
  vec2 lookup = vec2(0.0, 0.5 / float(textureSize(irradiance, 0).y));
  vec3 sky = sampleEquirect(irradiance, equirectUv(all.bent), lookup).rgb, below = sampleEquirect(irradiance, vec2(0.0, 1.0), lookup).rgb;
  around = vec4(aroundSeen(all, n, lobe, sky, 0.0, below, below), 1.0);
  place = vec4(position, 1.0);
  facing = vec4(n, 0.0);
}
