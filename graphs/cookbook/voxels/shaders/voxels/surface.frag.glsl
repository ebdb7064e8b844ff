// A surface in the light of the sun, of the sky and of other surfaces. Behind meshes/surface.vert.glsl.
// read    sun, sun_map   as of @sun; as compare
//         light          voxels and their means, see voxels/unpack.comp.glsl
//         materials, material_maps?   see meshes/surface.glsl
// modify  radiance
#include "common/view.glsl"
#include "meshes/surface.glsl"
#include "sky_at.glsl"
#include "sun_seen.glsl"

uniform sampler3D light;
layout(std140) uniform Parameters { vec3 middle; float width; vec3 sunlight; float bounce; };
#include "cube.glsl"
out vec4 radiance;

// Mean radiance that comes through a cone; `open`: its width at distance 1. A step is half as long as the cone is wide there.
vec3 cone(vec3 from, vec3 direction, float open) {
  float voxel = width / float(textureSize(light, 0).x), way = voxel;
  vec4 sum = vec4(0.0);
  while (sum.a < 0.98 && way < 1.8 * width) {
    float wide = max(open * way, voxel);
    vec4 here = textureLod(light, inCube(from + way * direction), log2(wide / voxel));
    // `here` is for a step as long as the cone is wide.
    float covered = 1.0 - sqrt(max(1.0 - here.a, 0.0));
    sum += (1.0 - sum.a) * vec4(here.a > 0.0 ? here.rgb / here.a : vec3(0.0), 1.0) * covered;
    way += 0.5 * wide;
  }
  return bounce * sum.rgb + (1.0 - sum.a) * skyAt(direction, open);
}

void main() {
  MeshSurface self = meshSurface();
  vec3 n = normalize(gl_FrontFacing ? world_normal : -world_normal), to_eye = towardsEye(world_position);
  vec3 from = world_position + 1.5 * width / float(textureSize(light, 0).x) * n;

  // Six cones of 60 degrees cover the hemisphere; their shares are those of the cosine.
  vec3 x = normalize(cross(abs(n.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), n)), y = cross(n, x);
  vec3 around = 0.25 * cone(from, n, 1.1547);
  for (int i = 0; i < 5; ++i) {
    float turn = 1.256637 * float(i);
    around += 0.15 * cone(from, 0.5 * n + 0.866025 * (cos(turn) * x + sin(turn) * y), 1.1547);
  }
  // And one for the gloss, with Schlick's Fresnel.
  float alpha = self.roughness * self.roughness;
  float fresnel = 0.04 + 0.96 * pow(1.0 - max(dot(self.normal, to_eye), 0.0), 5.0) * (1.0 - alpha);
  vec3 gloss = cone(from, reflect(-to_eye, self.normal), max(2.0 * alpha, 0.05));

  float facing = max(dot(self.normal, sun_light[0].direction), 0.0);
  vec3 direct = sunlight * facing * sunSeen(world_position, n) / 3.14159;
  radiance = vec4(self.albedo * (1.0 - fresnel) * (direct + around) + fresnel * gloss + self.emissive, 1.0);
}
