#include "engine/assets/models/parts/texture_pool.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "assets_sentences.h"
#include "engine/assets/images/image_codecs.h"
#include "engine/text/hash.h"
#include "engine/text/limits.h"

namespace weft::assets {

using text::Code;

namespace {

std::uint64_t hashOf(const Image8& image) {
  const std::string_view texels(reinterpret_cast<const char*>(image.texels.data()), image.texels.size());
  return text::hashBytes(texels, text::hashCombine(static_cast<std::uint64_t>(image.width),
                                                   static_cast<std::uint64_t>(image.height)));
}

// Magenta and black, 8 x 8 squares: nobody takes it for a surface.
std::shared_ptr<const Image8> makeCheckerboard() {
  Image8 image{64, 64, 4, {}};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const std::uint8_t value = (x / 8 + y / 8) % 2 == 0 ? 255 : 0;
      image.texels.insert(image.texels.end(), {value, 0, value, 255});
    }
  return std::make_shared<const Image8>(std::move(image));
}

bool isBlue(const Image8& image) {
  double sums[4] = {};
  for (std::size_t i = 0; i < image.texels.size(); ++i) sums[i % 4] += image.texels[i];
  return sums[2] > 1.2 * sums[0] && sums[2] > 1.2 * sums[1];
}

}  // namespace

std::uint32_t TexturePool::put(std::string bytes, const std::string& name, const text::Place& place) {
  Entry entry{.bytes = std::move(bytes), .name = name, .place = place};
  if (const auto size = readPictureHeader(entry.bytes, name, entry.found)) {
    entry.texels = static_cast<std::uint64_t>(size->width) * static_cast<std::uint64_t>(size->height);
    entry.channels = size->channels;
    const std::uint64_t wide = size->type == StoredType::word ? 2 : 1;  // while they are decoded
    if (!countTexels(entry.texels * wide, name, place)) return kNoRow;
  } else {
    entry.bytes.clear();
  }
  images_.push_back(std::move(entry));
  return static_cast<std::uint32_t>(images_.size() - 1);
}

bool TexturePool::countTexels(std::uint64_t texels, const std::string& name, const text::Place& place) {
  texels += texels_;
  const bool fits = texels <= text::raised(kMaxTexels);
  if (fits)
    texels_ = texels;
  else if (!std::exchange(full_, true))
    text::reportLimit(diagnostics_, place, fmt::format("with '{}' the model's textures are too large", name),
                      kMaxTexels, "texels of all textures of one model", texels);
  return fits;
}

void TexturePool::reportMissing(const std::string& name, const std::string& why, const text::Place& place) {
  diagnostics_.warning(say::textureCannotBeUsed, place, name, why);
}

std::uint32_t TexturePool::use(std::uint32_t image, const std::string& name, TextureUse use,
                               const text::Place& place) {
  if (image == kNoRow && use != TextureUse::color) return kNoRow;
  uses_.push_back({image, name, use, place});
  return static_cast<std::uint32_t>(uses_.size() - 1);
}

std::uint32_t TexturePool::useMade(std::uint32_t first, std::uint32_t second, MakeTexel make,
                                   const std::string& name, TextureUse use, const text::Place& place) {
  std::uint64_t texels = 0;
  for (const std::uint32_t image : {first, second})
    if (image != kNoRow) texels = std::max(texels, images_[image].texels);
  if (texels == 0 || !countTexels(texels, name, place)) return kNoRow;
  uses_.push_back({first, name, use, place, second, std::move(make)});
  return static_cast<std::uint32_t>(uses_.size() - 1);
}

std::shared_ptr<const Image8> TexturePool::makeImage(const Use& use) const {
  const auto imageOf = [&](std::uint32_t row) { return row == kNoRow ? nullptr : images_[row].image; };
  std::shared_ptr<const Image8> first = imageOf(use.image), second = imageOf(use.second);
  const auto texelsOf = [](const auto& image) { return image ? image->texels.size() : 0; };
  const std::shared_ptr<const Image8>& larger = texelsOf(first) < texelsOf(second) ? second : first;
  if (!larger) return nullptr;
  Image8 made{larger->width, larger->height, 4, std::vector<std::uint8_t>(larger->texels.size())};
  const auto fit = [&](std::shared_ptr<const Image8>& image) {
    if (image && (image->width != made.width || image->height != made.height))
      image = std::make_shared<const Image8>(resize(*image, made.width, made.height, false));
  };
  fit(first);
  fit(second);
  const auto texelAt = [](const auto& image, std::size_t at) {
    const std::uint8_t* t = image ? image->texels.data() + at : nullptr;
    return t ? glm::u8vec4(t[0], t[1], t[2], t[3]) : glm::u8vec4(255);
  };
  for (std::size_t at = 0; at + 3 < made.texels.size(); at += 4) {
    const glm::u8vec4 texel = use.make(texelAt(first, at), texelAt(second, at));
    for (int c = 0; c < 4; ++c) made.texels[at + static_cast<std::size_t>(c)] = texel[c];
  }
  return std::make_shared<const Image8>(std::move(made));
}

bool TexturePool::decodeAll() {
  tbb::parallel_for(std::size_t{0}, images_.size(), [&](std::size_t number) {
    if (files_.stop().stop_requested()) return;
    Entry& entry = images_[number];
    if (!entry.bytes.empty())
      if (auto decoded = decodePicture<std::uint8_t>(entry.bytes, 4, entry.name, entry.found)) {
        entry.content = hashOf(*decoded);
        entry.image = std::make_shared<const Image8>(std::move(*decoded));
      }
    entry.bytes = {};
  });
  return !files_.stop().stop_requested();
}

std::uint32_t TexturePool::rowOf(const Use& use, std::vector<Texture>& textures) {
  std::shared_ptr<const Image8> image = use.make              ? makeImage(use)
                                        : use.image == kNoRow ? nullptr
                                                              : images_[use.image].image;
  const bool color = use.use == TextureUse::color;
  if (!image && !color) return kNoRow;
  if (use.use == TextureUse::bump && !isBlue(*image)) {
    diagnostics_.warning(say::bumpMapLeftOut, use.place, use.name);
    return kNoRow;
  }
  static const std::shared_ptr<const Image8> kMissing = makeCheckerboard();
  static const std::uint64_t kMissingContent = hashOf(*kMissing);
  const std::uint64_t content = text::hashCombine(!image     ? kMissingContent
                                                  : use.make ? hashOf(*image)
                                                             : images_[use.image].content,
                                                  color ? 1 : 0);
  const auto row =
      static_cast<std::size_t>(std::ranges::find(textures, content, &Texture::content) - textures.begin());
  if (row == textures.size()) {
    Texture& made = textures.emplace_back(use.name, image ? std::move(image) : kMissing, color, content);
    for (std::size_t t = 3; color && t < made.image->texels.size() && !made.clear; t += 4)
      made.clear = made.image->texels[t] < 255;
  }
  return static_cast<std::uint32_t>(row);
}

bool TexturePool::finish(Model& model) {
  if (!decodeAll()) return false;
  for (const Entry& entry : images_)
    if (!entry.image)
      reportMissing(entry.name, entry.found.empty() ? "it is empty" : entry.found.items().front().message,
                    entry.place);
  for (Material& material : model.materials)
    for (std::uint32_t* map : material.maps())
      if (*map != kNoRow) *map = rowOf(uses_[*map], model.textures);
  return true;
}

}  // namespace weft::assets
