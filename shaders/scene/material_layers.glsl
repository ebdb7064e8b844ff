// What glTF's extensions say of the scene's materials. Slot: material_layers? (@material_layers ?).
#ifndef SCENE_MATERIAL_LAYERS_GLSL
#define SCENE_MATERIAL_LAYERS_GLSL

#ifdef HAS_MATERIAL_LAYERS
struct MaterialLayers {
  vec3 specular_color;   // of the dielectric: KHR_materials_specular
  float specular;
  vec3 sheen;            // KHR_materials_sheen
  float sheen_roughness;
  float ior;             // KHR_materials_ior
  uint layered;          // 0: this is a material without layers
  float coat, coat_roughness, coat_normal_scale;        // KHR_materials_clearcoat
  float anisotropy, anisotropy_turn;                    // KHR_materials_anisotropy
  float film, film_ior, film_min, film_max;             // KHR_materials_iridescence; nm
  float transmission;    // KHR_materials_transmission
  vec3 absorption;       // KHR_materials_volume: per world unit
  float thickness;       // in the mesh's units; 0: a thin wall
  uint specular_map, specular_color_map, coat_map, coat_roughness_map, coat_normal_map, sheen_map, sheen_roughness_map, anisotropy_map,
      film_map, film_thickness_map, transmission_map, thickness_map;
};
layout(std430) readonly buffer material_layers { MaterialLayers layers_of[]; };
#endif

#endif
