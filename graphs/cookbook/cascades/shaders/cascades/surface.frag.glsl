// A surface in the light of sun and sky, fainter with distance. Behind meshes/surface.vert.glsl.
// read    sun, windows   as of @sun; Window[]
//         shadow         the maps, as compare
//         materials, material_maps?   see meshes/surface.glsl
// modify  radiance
#include "common/view.glsl"
#include "meshes/surface.glsl"
#include "scene/sun.glsl"
#include "window.glsl"

layout(std430) readonly buffer windows { Window window[]; };
uniform sampler2DArrayShadow shadow;
layout(std140) uniform Parameters { bool show_maps; vec3 sunlight; };
out vec4 radiance;
#include "sky_at.glsl"

// Share of the sun that is seen by way of map i: nine lookups, each of four texels.
float seenIn(int i, vec3 position, vec3 n) {
  // Off the surface, or it would shade itself.
  Window self = window[i];
  vec3 at = (sun_light[0].shadow_matrix * vec4(position + 2.0 * self.texel * n, 1.0)).xyz;
  vec2 on_map = (at.xy - self.corner) / self.size;
  float sum = 0.0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x)
      sum += texture(shadow, vec4(on_map + vec2(x, y) / vec2(textureSize(shadow, 0).xy), float(i), at.z));
  return sum / 9.0;
}

void main() {
  MeshSurface self = meshSurface();
  vec3 light = sun_light[0].direction;
  float far = dot(eye - world_position, transpose(mat3(view))[2]);
  int last = window.length() - 1, i = 0;
  while (i < last && far > window[i].end) ++i;
  float seen = far > window[last].end ? 1.0 : seenIn(i, world_position, normalize(world_normal));

  float facing = max(dot(self.normal, light), 0.0);
  vec3 sky = mix(vec3(0.2, 0.18, 0.15), vec3(0.35, 0.45, 0.65), 0.5 + 0.5 * self.normal.y) * self.occlusion;
  vec3 lit = self.albedo * (facing * seen * sunlight / 3.14159 + sky);
  if (show_maps) lit *= far > window[last].end ? vec3(0.5) : mix(vec3(0.5), vec3(i % 3 == 0, i % 3 == 1, i % 3 == 2) + 0.6 * vec3(i / 3 % 2), 0.5) * 1.5;
  vec3 ray = world_position - eye;
  radiance = vec4(mix(skyAt(normalize(ray * vec3(1.0, 0.0, 1.0))), lit, exp(-0.012 * length(ray))), 1.0);
}
