// Evaluates the material and the normal of a mesh at a pixel, with their maps.
// Slots: materials (@materials), material_maps? (@material_maps as linear wrap). Behind meshes/surface.vert.glsl.
// define SPECULAR_AA: the variation of the normal, mapped or not, within the pixel widens the roughness (Tokuyoshi and Kaplanyan,
// "Improved geometric specular antialiasing", I3D 2019). The factor of their listing, 0.5, blurs mirrors more than a pixel does; 0.006
// comes nearest to 64 samples per pixel, for metals of roughness 0 to 0.3.
#ifndef MESHES_SURFACE_GLSL
#define MESHES_SURFACE_GLSL

#include "scene/materials.glsl"
#include "shading/point.glsl"

#ifndef SPECULAR_AA
#define SPECULAR_AA 1
#endif

in vec3 world_position;
in vec3 world_normal;
in vec4 world_tangent;
in vec2 map_uv;
#ifdef HAS_SECOND_UVS
in vec2 map_uv_2;
#endif
in vec4 previous_clip;
flat in uint row;
// From the vertex shader: derivatives need them in pixels beside the triangle, where llvmpipe reads 0 from buffers.
flat in uint normal_map;
flat in float normal_scale;
#ifdef HAS_VERTEX_COLORS
in vec4 own_color;
#endif
#ifdef HAS_BEHIND
flat in float world_scale;
#endif

struct MeshSurface {
  vec3 normal;       // world, unit, towards the viewer's side of a double-sided material
  vec3 albedo;       // linear; F0 of a metal
  vec3 emissive;     // radiance, scene-referred
  float metallic, roughness, occlusion, alpha;
  float lit;         // 0: it shows `emissive` alone
  float shininess;   // of Blinn–Phong; 0: none
};

// Where maps are looked up, with derivatives: to be asked for where all pixels of a quad are.
struct MapPlace {
  vec2 uv, dx, dy;
#ifdef HAS_SECOND_UVS
  vec2 uv_2, dx_2, dy_2;
#endif
};
MapPlace mapPlace() {
  return MapPlace(map_uv, dFdx(map_uv), dFdy(map_uv)
#ifdef HAS_SECOND_UVS
                  , map_uv_2, dFdx(map_uv_2), dFdy(map_uv_2)
#endif
  );
}
vec4 mapAt(uint map, MapPlace place) {
#ifdef HAS_SECOND_UVS
  if ((map & kAtSecondUv) != 0u) return sampleMap(map, place.uv_2, place.dx_2, place.dy_2);
#endif
  return sampleMap(map, place.uv, place.dx, place.dy);
}

bool hidden = false;  // in a hole of a mask

// Discards the fragment on the back of a single-sided material (draw with "cull": "none") and in a hole of a mask. With SEES_SCENE the includer
// discards what is `hidden`, at its end: pixels beside each other share what they see of the scene.
MeshSurface meshSurface() {
  Material self = material[row];
  MapPlace place = mapPlace();
  vec3 n = normalize(world_normal);
  uint maps[5] = uint[](self.albedo_map, normal_map, self.metallic_roughness_map, self.occlusion_map, self.emissive_map);
  vec4 texel[5];
  for (int i = 0; i < 5; ++i) texel[i] = mapAt(maps[i], place);
  vec4 color = texel[0] * vec4(self.albedo, self.alpha);
#ifdef HAS_VERTEX_COLORS
  color *= own_color;
#endif
  if (normal_map != 0xffffffffu) {
    vec3 tilt = (texel[1].xyz * 2.0 - 1.0) * vec3(normal_scale, normal_scale, 1.0);
    vec3 t = world_tangent.xyz - n * dot(n, world_tangent.xyz);
    if (dot(t, t) > 0.0) {
      t = normalize(t);
      n = normalize(mat3(t, cross(n, t) * world_tangent.w, n) * tilt);
    }
  }
#if SPECULAR_AA
  vec3 n_dx = dFdx(n), n_dy = dFdy(n);
#endif
  hidden = color.a < self.alpha_cutoff;
  // Pixels beside the triangle stay: llvmpipe reads 0 from buffers there.
  if ((hidden && SEES_SCENE == 0) || (self.double_sided == 0u && !gl_FrontFacing && !gl_HelperInvocation)) discard;
  if (!gl_FrontFacing) n = -n;
  MeshSurface surface;
  surface.normal = n;
  surface.albedo = color.rgb;
  surface.alpha = self.blends != 0u ? color.a : 1.0;
  surface.emissive = self.emissive * texel[4].rgb;
  surface.lit = self.unlit == 0u ? 1.0 : 0.0;
#ifdef HAS_VERTEX_COLORS
  if (self.unlit != 0u) surface.emissive *= own_color.rgb;
#endif
  surface.metallic = self.metallic * texel[2].b;
  surface.roughness = self.roughness * texel[2].g;
  surface.occlusion = mix(1.0, texel[3].r, self.occlusion_strength);
  surface.shininess = self.blinn_phong != 0u ? self.shininess : 0.0;
#if SPECULAR_AA
  float variance = 0.006 * (dot(n_dx, n_dx) + dot(n_dy, n_dy));
  float alpha = surface.roughness * surface.roughness;
  surface.roughness = sqrt(sqrt(clamp(alpha * alpha + variance, 0.0, 1.0)));
#endif
  return surface;
}

// Screen UV per frame, of a fragment.
vec2 meshVelocity(vec2 viewport) {
  return gl_FragCoord.xy / viewport - (previous_clip.xy / max(previous_clip.w, 1e-3) * 0.5 + 0.5);
}

#endif
