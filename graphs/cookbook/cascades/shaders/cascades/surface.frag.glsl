// A surface in the light of sun and sky, fainter with distance. Behind meshes/surface.vert.glsl.
// read    sun            as of @sun
//         windows        see shadow/sun_windows.comp.glsl
//         shadow         the maps, as compare
//         materials, material_maps?   see meshes/surface.glsl
// modify  radiance
#include "common/view.glsl"
#include "meshes/surface.glsl"
#include "scene/sun.glsl"

layout(std430) readonly buffer windows { Sun window[]; };
uniform sampler2DArrayShadow shadow;
layout(std140) uniform Parameters { bool show_maps; vec3 sunlight; };
out vec4 radiance;
#include "sky_at.glsl"

// Share of the sun that is seen by way of a map: nine lookups, each of four texels.
float seenIn(int map, Sun self, vec3 position, vec3 n) {
  // Off the surface, or it would shade itself.
  vec3 at = (self.shadow_matrix * vec4(position + 2.0 * self.texel * n, 1.0)).xyz;
  float sum = 0.0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x)
      sum += texture(shadow, vec4(at.xy + vec2(x, y) / vec2(textureSize(shadow, 0).xy), float(map), at.z));
  return sum / 9.0;
}

void main() {
  MeshSurface self = meshSurface();
  vec3 light = sun_light[0].direction;
  Sun through = sun_light[0];
  int map = 0;
  float rim = 4.0 / float(textureSize(shadow, 0).x);  // how far the lookups go
  for (int i = 0; i < window.length(); ++i) {
    vec2 off = abs((window[i].shadow_matrix * vec4(world_position, 1.0)).xy - 0.5);
    if (max(off.x, off.y) < 0.5 - rim) {
      through = window[i];
      map = i + 1;
    }
  }
  float seen = seenIn(map, through, world_position, normalize(world_normal));

  float facing = max(dot(self.normal, light), 0.0);
  vec3 sky = mix(vec3(0.2, 0.18, 0.15), vec3(0.35, 0.45, 0.65), 0.5 + 0.5 * self.normal.y) * self.occlusion;
  vec3 lit = self.albedo * (facing * seen * sunlight / 3.14159 + sky);
  if (show_maps) lit *= map == 0 ? vec3(0.75) : 1.5 * mix(vec3(0.5), vec3(map % 3 == 1, map % 3 == 2, map % 3 == 0) + 0.6 * vec3((map - 1) / 3 % 2), 0.5);
  vec3 ray = world_position - eye;
  radiance = vec4(mix(skyAt(normalize(ray * vec3(1.0, 0.0, 1.0))), lit, exp(-0.012 * length(ray))), 1.0);
}
