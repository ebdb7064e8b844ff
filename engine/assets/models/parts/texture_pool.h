// The textures of one model, shared by what is in them: an image is decoded once, and equal texels of one use are one row.
// A missing image is a warning (W167) and a checkerboard where it is a colour, else no map. Does not: know file formats.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/assets/model.h"
#include "engine/base/diagnostic.h"

namespace weft::assets {

class TexturePool {
 public:
  explicit TexturePool(base::Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  // Decodes the bytes of an image, with 4 channels. Null after W167 for damaged ones, or W201 beyond the limit model_texels.
  std::shared_ptr<const Image8> decode(std::string_view bytes, const std::string& name,
                                       const base::Place& place);
  // W167: there is no image.
  void reportMissing(const std::string& name, const std::string& why, const base::Place& place);
  // A row of textures(); `image` null: kNoRow, or the stand-in for a colour.
  std::uint32_t add(std::shared_ptr<const Image8> image, const std::string& name, bool srgb);

  bool full() const { return full_; }
  std::vector<ModelTexture> take() { return std::move(textures_); }

 private:
  base::Diagnostics& diagnostics_;
  std::vector<ModelTexture> textures_;
  std::multimap<std::uint64_t, std::uint32_t> byContent_;
  std::shared_ptr<const Image8> standIn_;
  std::uint64_t texels_ = 0;
  bool full_ = false;
};

}  // namespace weft::assets
