// The textures of one model, shared by what is in them: an image is decoded once, and equal texels of one use are one row.
// Images are put in first, then decoded all at once, then used. A missing image is a warning (W167) and a checkerboard where
// it is a color, else no map.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/assets/loading/load_observer.h"
#include "engine/assets/model.h"
#include "engine/text/diagnostic.h"

namespace weft::assets {

class TexturePool {
 public:
  explicit TexturePool(text::Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  // Puts the bytes of an image in: its number. kNoRow after W201, beyond the limit model_texels.
  std::uint32_t put(std::string bytes, const std::string& name, const text::Place& place);
  // Decodes what was put in since the last call, with 4 channels; W167 for damaged ones, in the order of their numbers.
  // `observer` hears of stage `decoding` from `from` on. False when it gave up.
  bool decodeAll(const DecodeRunner& runner, const LoadObserver& observer, double from = 0);
  // Null where an image could not be decoded.
  const Image8* image(std::uint32_t number) const { return images_[number].image.get(); }
  // W167: there is no image.
  void reportMissing(const std::string& name, const std::string& why, const text::Place& place);
  // A row of the textures, of an image that was decoded; kNoRow, or the stand-in for a color, where there is none.
  std::uint32_t add(std::uint32_t image, const std::string& name, bool srgb);

  std::vector<Texture> take() { return std::move(textures_); }

 private:
  struct Entry {
    std::string bytes, name;
    text::Place place;
    std::shared_ptr<const Image8> image;
    std::uint64_t content = 0;  // hash of size and texels
    text::Diagnostics found;
  };
  static void decode(Entry& entry);

  text::Diagnostics& diagnostics_;
  std::vector<Entry> images_;
  std::size_t first_ = 0;  // that is not decoded
  std::vector<Texture> textures_;
  std::map<std::uint64_t, std::uint32_t> byContent_;
  std::uint32_t standIn_ = kNoRow;  // its number
  std::uint64_t texels_ = 0;
  bool full_ = false;
};

}  // namespace weft::assets
