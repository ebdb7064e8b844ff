// KHR_materials_pbrSpecularGlossiness as the albedo, metallic and roughness that look the same. Internal to the folder.
#pragma once

#include "engine/assets/models/parts/texture_pool.h"

namespace weft::assets {

struct SpecGloss {
  glm::vec3 diffuse{1}, specular{1};  // linear
  float glossiness = 1;
};

struct Metallic {
  glm::vec3 albedo{1};
  float metallic = 0, roughness = 0;
};

Metallic toMetallic(const SpecGloss& from);

// Of a texel of the diffuse map and one of the specular-glossiness map, with these factors.
MakeTexel makeAlbedo(const SpecGloss& factors);
MakeTexel makeMetallicRoughness(const SpecGloss& factors);

}  // namespace weft::assets
