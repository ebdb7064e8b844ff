// Materials and the textures that they name: rows of Scene::materials and Scene::textures.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>

#include "engine/assets/images/image.h"
#include "engine/scene/table.h"

namespace weft::scene {

struct Texture {
  std::string name;
  std::shared_ptr<const assets::Image8> image;  // 4 channels, row 0 on top
  bool srgb = false;                            // colour: to be decoded
  std::uint64_t content = 0;                    // hash of size, texels and srgb; equal contents are one row
};
using TextureId = Table<Texture>::Id;

struct Material {
  std::string name;
  glm::vec3 albedo{
      0.5f};  // linear; F0 of a metal. Like all numbers here a factor of its map, where there is one
  float metallic = 0;
  float roughness = 0.5f;  // perceptual
  glm::vec3 emissive{0};   // linear, scene-referred
  float alpha = 1;         // below 1 only where the material blends: such an instance is transparent
  float alphaCutoff = 0;   // over 0: texels whose alpha is below it are holes
  bool blend = false;      // alpha of factor and map is coverage
  float normalScale = 1, occlusionStrength = 1;
  // Where the file has these (OBJ, FBX). Metallic and roughness are then a conversion: docs/scenes.md.
  bool blinnPhong = false;
  glm::vec3 specular{0};
  float shininess = 0;
  bool doubleSided = false;
  // Channels are those of glTF: roughness is g, metallic b, occlusion r.
  TextureId albedoMap, normalMap, metallicRoughnessMap, occlusionMap, emissiveMap;
};
using MaterialId = Table<Material>::Id;

}  // namespace weft::scene
