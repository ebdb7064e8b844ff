// Evaluates the layers of a mesh's material at a pixel. Behind meshes/surface.glsl. Slot: material_layers? see scene/material_layers.glsl
#ifndef MESHES_LAYERS_GLSL
#define MESHES_LAYERS_GLSL

#include "meshes/surface.glsl"
#include "scene/material_layers.glsl"
#include "shading/layers.glsl"

#ifdef HAS_MATERIAL_LAYERS
// To be called before meshSurface(): llvmpipe of Mesa 22.3 dies of such lookups behind a discard.
Layers meshLayers() {
  MaterialLayers self = layers_of[row];
  MapPlace place = mapPlace();
  float side = gl_FrontFacing ? 1.0 : -1.0;
  uint maps[10] = uint[](self.specular_map, self.specular_color_map, self.coat_map, self.coat_roughness_map, self.coat_normal_map, self.sheen_map,
                         self.sheen_roughness_map, self.anisotropy_map, self.film_map, self.film_thickness_map);
  vec4 texel[10];
  for (int i = 0, end = self.layered != 0u ? 10 : 0; i < end; ++i) texel[i] = mapAt(maps[i], place);
  vec4 specular = vec4(self.specular_color * texel[1].rgb, self.specular * texel[0].a);
  float r = (self.ior - 1.0) / (self.ior + 1.0);
  Layers layers;
  layers.on = self.layered != 0u;
  layers.f0 = min(r * r * specular.rgb, 1.0) * specular.a;
  layers.f90 = specular.a;
  layers.sheen = self.sheen * texel[5].rgb;
  layers.sheen_roughness = self.sheen_roughness * texel[6].a;

  layers.coat = self.coat * texel[2].r;
  layers.coat_roughness = self.coat_roughness * texel[3].g;
  vec3 geometric = normalize(world_normal);
  layers.coat_normal = geometric * side;
  vec3 t = world_tangent.xyz - geometric * dot(geometric, world_tangent.xyz);
  if (self.coat_normal_map != 0xffffffffu && dot(t, t) > 0.0) {
    vec3 tilt = (texel[4].xyz * 2.0 - 1.0) * vec3(vec2(self.coat_normal_scale), 1.0);
    t = normalize(t);
    layers.coat_normal = normalize(mat3(t, cross(geometric, t) * world_tangent.w, geometric) * tilt) * side;
  }

  t = dot(t, t) > 0.0 ? normalize(t) : vec3(1.0, 0.0, 0.0);
  vec3 grooves = texel[7].xyz;
  vec2 towards = self.anisotropy_map == 0xffffffffu ? vec2(1.0, 0.0) : normalize(grooves.xy * 2.0 - 1.0 + vec2(1e-6, 0.0));
  vec2 turn = vec2(cos(self.anisotropy_turn), sin(self.anisotropy_turn));
  towards = mat2(turn, vec2(-turn.y, turn.x)) * towards;
  layers.along = t * towards.x + cross(geometric, t) * (world_tangent.w * towards.y);
  layers.anisotropy = self.anisotropy * grooves.z;

  layers.film = self.film * texel[8].r;
  layers.film_ior = self.film_ior;
  layers.film_thickness = mix(self.film_min, self.film_max, texel[9].g);
#ifdef HAS_BEHIND
  layers.transmission = self.transmission * mapAt(self.transmission_map, place).r;
  layers.thickness = self.thickness * mapAt(self.thickness_map, place).g * world_scale;
  layers.absorption = self.absorption;
  layers.ior = max(self.ior, 1.0);
#endif
  return layers;
}
#endif

#endif
