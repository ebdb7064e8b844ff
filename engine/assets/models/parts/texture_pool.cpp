#include "engine/assets/models/parts/texture_pool.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "engine/assets/images/image_codecs.h"
#include "engine/assets/models/parts/model_files.h"
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

void TexturePool::reportMissing(const std::string& name, const std::string& why, const text::Place& place) {
  text::Diagnostic& d =
      diagnostics_.warning(Code::missingModelTexture, place,
                           fmt::format("the model's texture '{}' cannot be used: {}", name, why));
  d.expected = "a .png, .jpg or .tga image in the folder of the model";
  d.hint = "a color is shown as a magenta checkerboard instead; other maps are left out";
}

std::uint32_t TexturePool::use(std::uint32_t image, const std::string& name, TextureUse use,
                               const text::Place& place) {
  if (image == kNoRow && use != TextureUse::color) return kNoRow;
  uses_.push_back({image, name, use, place});
  return static_cast<std::uint32_t>(uses_.size() - 1);
}

bool TexturePool::decodeAll(const LoadObserver& observer, double from) {
  if (observer && !observer(LoadStage::decoding, from)) return false;
  const std::size_t count = images_.size();
  const std::thread::id loader = std::this_thread::get_id();  // on which the observer is asked
  std::atomic<std::size_t> done = 0;
  std::atomic<bool> gaveUp = false;
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t number) {
    if (gaveUp) return;
    Entry& entry = images_[number];
    if (!entry.bytes.empty())
      if (auto decoded = decodePicture<std::uint8_t>(entry.bytes, 4, entry.name, entry.found)) {
        entry.content = hashOf(*decoded);
        entry.image = std::make_shared<const Image8>(std::move(*decoded));
      }
    entry.bytes = {};
    const double share = static_cast<double>(++done) / static_cast<double>(count);
    if (observer && std::this_thread::get_id() == loader &&
        !observer(LoadStage::decoding, from + (1 - from) * share))
      gaveUp = true;
  });
  return !gaveUp;
}

std::uint32_t TexturePool::rowOf(const Use& use, std::vector<Texture>& textures) {
  std::shared_ptr<const Image8> image = use.image == kNoRow ? nullptr : images_[use.image].image;
  const bool color = use.use == TextureUse::color;
  if (!image && !color) return kNoRow;
  if (use.use == TextureUse::bump && !isBlue(*image)) {
    diagnostics_
        .warning(Code::modelPartLeftOut, use.place,
                 fmt::format("the bump map '{}' was left out: it holds heights, not normals", use.name))
        .hint = "make a normal map of it";
    return kNoRow;
  }
  static const std::shared_ptr<const Image8> kMissing = makeCheckerboard();
  const std::uint64_t content =
      text::hashCombine(image ? images_[use.image].content : hashOf(*kMissing), color ? 1 : 0);
  const auto row =
      static_cast<std::size_t>(std::ranges::find(textures, content, &Texture::content) - textures.begin());
  if (row == textures.size())
    textures.push_back({use.name, image ? std::move(image) : kMissing, color, content});
  return static_cast<std::uint32_t>(row);
}

bool TexturePool::finish(Model& model, const LoadObserver& observer, double from) {
  if (!decodeAll(observer, from)) return false;
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
