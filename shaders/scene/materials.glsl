// The scene's materials and their textures. Slots: materials (@materials), material_maps (@material_maps as linear wrap ?).
#ifndef SCENE_MATERIALS_GLSL
#define SCENE_MATERIALS_GLSL

struct Material {
  vec3 albedo;              // linear; factor of its map
  float metallic;
  vec3 emissive;            // radiance, scene-referred
  float roughness;          // perceptual
  vec3 specular;            // Blinn–Phong
  float shininess;
  float alpha, alpha_cutoff;
  float normal_scale, occlusion_strength;
  uint albedo_map, normal_map, metallic_roughness_map, occlusion_map, emissive_map;
  uint blinn_phong, double_sided;
};
layout(std430) readonly buffer materials { Material material[]; };

#ifdef HAS_MATERIAL_MAPS
uniform sampler2DArray material_maps[8];

// White when `map` is none. The caller gives the derivatives, because not all pixels of a quad may take the same branch here.
vec4 sampleMap(uint map, vec2 uv, vec2 dx, vec2 dy) {
  vec3 at = vec3(uv, float(map & 0xffffu));
  vec4 texel = vec4(1.0);
  for (uint i = 0u; i < 8u; ++i)  // the index of a sampler is the same for all invocations that are here
    if (map >> 16 == i) texel = textureGrad(material_maps[i], at, dx, dy);
  return texel;
}
#else
vec4 sampleMap(uint map, vec2 uv, vec2 dx, vec2 dy) { return vec4(1.0); }
#endif

#endif
