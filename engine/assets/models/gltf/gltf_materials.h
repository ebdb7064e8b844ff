// Materials and images of a glTF document. Internal to the folder.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "engine/assets/models/gltf/gltf_document.h"
#include "engine/assets/models/parts/texture_pool.h"

namespace weft::assets {

// Which uv set a material's maps are looked up with, and how they are moved: KHR_texture_transform. One for all maps of a
// material, because a vertex has one uv; maps that want another are left out, with W168.
struct GltfUv {
  std::uint32_t set = 0;
  std::array<float, 2> offset{0, 0}, scale{1, 1};
  float rotation = 0;  // radians
  friend bool operator==(const GltfUv&, const GltfUv&) = default;
};

struct GltfMaterials {
  std::vector<Material> materials;  // the file's, and then one for meshes without
  std::vector<GltfUv> uvs;          // parallel
};

// Decodes what the materials use, by `decode`, or in turn where that is empty. `observer` hears how far it is; empty after errors, or when it gave up.
std::optional<GltfMaterials> readGltfMaterials(GltfDocument& document, ModelFiles& files, TexturePool& pool,
                                               const LoadObserver& observer, const DecodeRunner& decode,
                                               base::Diagnostics& diagnostics);

}  // namespace weft::assets
