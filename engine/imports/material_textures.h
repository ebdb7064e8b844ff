// The textures of a scene's materials, batched in arrays by size and kind (sRGB or not), so that a material is an index and
// never a rebind. Where there are too many sizes, a texture is scaled to a size that has an array. Uploaded with all their
// levels when a scene with others arrives.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/gl/objects/objects.h"
#include "engine/scene/scene.h"
#include "engine/text/diagnostic.h"

namespace weft::imports {

constexpr std::uint32_t kMaterialArrays = 8;  // samplers that a shader declares: material_maps[8]
constexpr std::uint32_t kNoMap = 0xffffffffu;

struct MaterialArray {
  std::uint32_t width = 1, height = 1;  // of level 0
  bool srgb = false;
  std::vector<std::uint32_t> textures;  // rows of Scene::textures, by layer
};

// At most kMaterialArrays, those with most texels first; none for a scene without textures. Each texture is in one.
std::vector<MaterialArray> batchTextures(const scene::Scene& scene);
// layer | array << 16 per row of Scene::textures.
std::vector<std::uint32_t> mapsOf(const std::vector<MaterialArray>& arrays, std::size_t textures);

class MaterialTextures {
 public:
  // The array for sampler `element`; of one that there is not, a white texel. Id 0 after an error.
  gl::TextureRef array(const scene::Scene& scene, std::uint64_t generation, std::uint32_t element,
                       text::Diagnostics& diagnostics);

 private:
  bool renew(const scene::Scene& scene, text::Diagnostics& diagnostics);

  std::uint64_t generation_ = 0;
  std::vector<std::uint64_t> contents_;  // Texture::content of what is uploaded, in the order of the rows
  std::vector<gl::Texture> arrays_;
  gl::Texture white_;
};

}  // namespace weft::imports
