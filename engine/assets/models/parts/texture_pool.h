// The textures of one model. Images are put in first, materials name them by use(), and finish() decodes all at once: an image is
// decoded once, and equal texels of one use are one row. A missing image is a warning (W167) and a checkerboard where it is a
// color, else no map.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/assets/images/image.h"
#include "engine/assets/model.h"
#include "engine/assets/models/parts/model_files.h"
#include "engine/text/diagnostic.h"

namespace weft::assets {

// What of a material an image is. A bump map is a height, but most exporters write normal maps there: it is taken where it is blue.
enum class TextureUse : std::uint8_t { color, numbers, bump };

// A texel, RGBA as stored, of one of each of two images; white where there is no image.
using MakeTexel = std::function<glm::u8vec4(const glm::u8vec4& first, const glm::u8vec4& second)>;

class TexturePool {
 public:
  explicit TexturePool(const ModelFiles& files) : files_(files), diagnostics_(files.diagnostics()) {}

  // Puts the bytes of an image in: its number. kNoRow after W201, beyond the limit model_texels.
  std::uint32_t put(std::string bytes, const std::string& name, const text::Place& place);
  // W167: there is no image.
  void reportMissing(const std::string& name, const std::string& why, const text::Place& place);
  // What a map of a material becomes until finish(). `image` is a number, or kNoRow.
  std::uint32_t use(std::uint32_t image, const std::string& name, TextureUse use, const text::Place& place);
  // The same of a picture that is made of two images, either of which may be kNoRow, in the size of the larger one.
  std::uint32_t useMade(std::uint32_t first, std::uint32_t second, MakeTexel make, const std::string& name,
                        TextureUse use, const text::Place& place);
  // Whether the image has a channel of its own for alpha.
  bool hasAlpha(std::uint32_t image) const { return images_[image].channels % 2 == 0; }

  // Decodes all images, on the threads of the machine, W167 for damaged ones in the order of their numbers, and gives textures and maps of materials their rows.
  // False when the load was stopped.
  bool finish(Model& model);

 private:
  struct Entry {
    std::string bytes, name;
    text::Place place;
    std::uint64_t texels = 0;
    int channels = 4;  // of the file
    std::shared_ptr<const Image8> image{};
    std::uint64_t content = 0;  // hash of size and texels
    text::Diagnostics found{};
  };
  struct Use {
    std::uint32_t image = 0;
    std::string name;
    TextureUse use = TextureUse::color;
    text::Place place;
    std::uint32_t second = kNoRow;
    MakeTexel make{};  // empty: the image as it is
  };
  // False after W201, once.
  bool countTexels(std::uint64_t texels, const std::string& name, const text::Place& place);
  std::shared_ptr<const Image8> makeImage(const Use& use) const;
  bool decodeAll();
  std::uint32_t rowOf(const Use& use, std::vector<Texture>& textures);

  const ModelFiles& files_;
  text::Diagnostics& diagnostics_;
  std::vector<Entry> images_;
  std::vector<Use> uses_;
  std::uint64_t texels_ = 0;
  bool full_ = false;
};

}  // namespace weft::assets
