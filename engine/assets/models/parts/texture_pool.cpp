#include "engine/assets/models/parts/texture_pool.h"

#include <fmt/format.h>

#include <atomic>
#include <thread>

#include "engine/assets/images/image_codecs.h"
#include "engine/assets/models/parts/model_files.h"
#include "engine/text/hash.h"
#include "engine/text/limits.h"

namespace weft::assets {

using text::Code;

namespace {

// Magenta and black, 8 x 8 squares: nobody takes it for a surface.
std::shared_ptr<const Image8> makeStandIn() {
  Image8 image{64, 64, 4, {}};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const std::uint8_t value = (x / 8 + y / 8) % 2 == 0 ? 255 : 0;
      image.texels.insert(image.texels.end(), {value, 0, value, 255});
    }
  return std::make_shared<const Image8>(std::move(image));
}

std::uint64_t hashOf(const Image8& image) {
  const std::string_view texels(reinterpret_cast<const char*>(image.texels.data()), image.texels.size());
  return text::hashBytes(texels, text::hashCombine(static_cast<std::uint64_t>(image.width),
                                                   static_cast<std::uint64_t>(image.height)));
}

}  // namespace

std::uint32_t TexturePool::put(std::string bytes, const std::string& name, const text::Place& place) {
  Entry entry{std::move(bytes), name, place, nullptr, 0, {}};
  if (const auto size = readPictureHeader(entry.bytes, name, entry.found)) {
    const std::uint64_t texels =
        texels_ + static_cast<std::uint64_t>(size->width) * static_cast<std::uint64_t>(size->height);
    if (texels > text::raised(kMaxTexels)) {
      if (!full_)
        text::reportLimit(diagnostics_, place,
                          fmt::format("with '{}' the model's textures are too large", name), kMaxTexels,
                          "texels of all textures of one model", texels)
            .found = fmt::format("{} texels", texels);
      full_ = true;
      return kNoRow;
    }
    texels_ = texels;
  } else {
    entry.bytes.clear();
  }
  images_.push_back(std::move(entry));
  return static_cast<std::uint32_t>(images_.size() - 1);
}

void TexturePool::decode(Entry& entry) {
  if (entry.bytes.empty()) return;
  if (auto decoded = decodePicture<std::uint8_t>(entry.bytes, 4, entry.name, entry.found)) {
    entry.content = hashOf(*decoded);
    entry.image = std::make_shared<const Image8>(std::move(*decoded));
  }
  entry.bytes = {};
}

bool TexturePool::decodeAll(const DecodeRunner& runner, const LoadObserver& observer, double from) {
  if (observer && !observer(LoadStage::decoding, from)) return false;
  const std::size_t count = images_.size() - first_;
  const std::thread::id loader = std::this_thread::get_id();  // on which the observer is asked
  std::atomic<std::size_t> done = 0;
  std::atomic<bool> gaveUp = false;
  const auto decodeOne = [&](std::size_t image) {
    if (gaveUp) return;
    decode(images_[first_ + image]);
    const double share = static_cast<double>(++done) / static_cast<double>(count);
    if (observer && std::this_thread::get_id() == loader &&
        !observer(LoadStage::decoding, from + (1 - from) * share))
      gaveUp = true;
  };
  if (runner && count > 0)
    runner(count, decodeOne);
  else
    for (std::size_t image = 0; image < count; ++image) decodeOne(image);
  if (gaveUp) return false;
  for (; first_ < images_.size(); ++first_) {
    const Entry& entry = images_[first_];
    if (!entry.image)
      reportMissing(entry.name, entry.found.empty() ? "it is empty" : entry.found.items().front().message,
                    entry.place);
  }
  return true;
}

void TexturePool::reportMissing(const std::string& name, const std::string& why, const text::Place& place) {
  text::Diagnostic& d =
      diagnostics_.warning(Code::missingModelTexture, place,
                           fmt::format("the model's texture '{}' cannot be used: {}", name, why));
  d.expected = "a .png, .jpg or .tga image in the folder of the model";
  d.hint = "a color is shown as a magenta checkerboard instead; other maps are left out";
}

std::uint32_t TexturePool::add(std::uint32_t number, const std::string& name, bool srgb) {
  if (number == kNoRow || !images_[number].image) {
    if (!srgb) return kNoRow;
    if (standIn_ == kNoRow) {
      standIn_ = static_cast<std::uint32_t>(images_.size());
      images_.push_back({{}, name, {}, makeStandIn(), 0, {}});
      images_.back().content = hashOf(*images_.back().image);
      first_ = images_.size();
    }
    number = standIn_;
  }
  const Entry& entry = images_[number];
  const std::uint64_t content = text::hashCombine(entry.content, srgb ? 1 : 0);
  const auto [row, isNew] = byContent_.try_emplace(content, static_cast<std::uint32_t>(textures_.size()));
  if (isNew) textures_.push_back({name, entry.image, srgb, content});
  return row->second;
}

}  // namespace weft::assets
