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
  uint blinn_phong, double_sided, unlit, blends;
};
layout(std430) readonly buffer materials { Material material[]; };

// Bits of the word of a map, as `materials` has them.
const uint kItsSampler = 31u << 20, kAtSecondUv = 1u << 25;

#ifdef HAS_MATERIAL_MAPS
uniform sampler2DArray material_maps[8];

// Where to look a map up whose own sampler does not just repeat it. Half a texel of the
// level that is seen stays between the place and an edge, so that nothing of the other side is mixed in.
vec2 placeInMap(uint map, vec2 uv, vec2 dx, vec2 dy) {
  vec2 size = vec2(1.0);
  for (uint i = 0u; i < 8u; ++i)
    if ((map >> 16 & 15u) == i) size = vec2(textureSize(material_maps[i], 0).xy);
  float level = 0.5 * log2(max(dot(dx * size, dx * size), dot(dy * size, dy * size)));
  vec2 margin = min(0.5 * exp2(max(ceil(level), 0.0)) / size, vec2(0.5)), mirrored = 1.0 - abs(mod(uv, 2.0) - 1.0);
  uvec2 wrap = uvec2(map >> 20, map >> 22) & 3u;
  vec2 at = mix(uv, mirrored, equal(wrap, uvec2(2u)));
  at = mix(at, clamp(at, margin, 1.0 - margin), greaterThan(wrap, uvec2(0u)));
  return (map >> 24 & 1u) != 0u && level <= 0.0 ? (floor(at * size) + 0.5) / size : at;
}

// White when `map` is none. The caller gives the derivatives, because not all pixels of a quad may take the same branch here.
vec4 sampleMap(uint map, vec2 uv, vec2 dx, vec2 dy) {
  if ((map & kItsSampler) != 0u && map != 0xffffffffu) uv = placeInMap(map, uv, dx, dy);
  vec3 at = vec3(uv, float(map & 0xffffu));
  vec4 texel = vec4(1.0);
  for (uint i = 0u; i < 8u; ++i)  // the index of a sampler is the same for all invocations that are here
    if ((map >> 16 & 15u) == i) texel = textureGrad(material_maps[i], at, dx, dy);
  return texel;
}
#else
vec4 sampleMap(uint map, vec2 uv, vec2 dx, vec2 dy) { return vec4(1.0); }
#endif

#endif
