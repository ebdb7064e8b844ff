// Puts what leaves a surface into its voxel: of several the greatest, so that the order does not matter.
// read    sun, sun_map   as of @sun; as compare
//         materials, material_maps?   see scene/materials.glsl
// modify  grid           packUnorm4x8 of the root of radiance / 4, and 1
// params  axis           that the view looks along
#include "scene/materials.glsl"
#include "sun_seen.glsl"

layout(r32ui) uniform uimage3D grid;
layout(std140) uniform Parameters { vec3 middle; float width; vec3 sunlight; int axis; };
#include "cube.glsl"
in vec3 world, world_normal;
in vec2 map_uv;
flat in uint row;

void main() {
  vec3 side = abs(cross(dFdx(world), dFdy(world)));
  int widest = side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
  Material self = material[row];
  vec4 color = vec4(self.albedo, self.alpha) * sampleMap(self.albedo_map, map_uv, dFdx(map_uv), dFdy(map_uv));
  ivec3 voxel = ivec3(floor(inCube(world) * vec3(imageSize(grid))));
  if (widest != axis || color.a < self.alpha_cutoff) return;
  if (any(lessThan(voxel, ivec3(0))) || any(greaterThanEqual(voxel, imageSize(grid)))) return;

  vec3 n = normalize(world_normal);
  vec3 light = color.rgb * sunlight * max(dot(n, sun_light[0].direction), 0.0) * sunSeen(world, n) / 3.14159 + self.emissive;
  imageAtomicMax(grid, voxel, packUnorm4x8(vec4(sqrt(min(light / 4.0, 1.0)), 1.0)));
}
