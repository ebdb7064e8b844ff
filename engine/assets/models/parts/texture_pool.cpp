#include "engine/assets/models/parts/texture_pool.h"

#include <fmt/format.h>

#include "engine/assets/images/image_codecs.h"
#include "engine/base/hash.h"
#include "engine/base/limit_report.h"
#include "engine/base/limits.h"

namespace weft::assets {

using base::Code;

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

std::uint64_t hashOf(const Image8& image, bool srgb) {
  const std::string_view texels(reinterpret_cast<const char*>(image.texels.data()), image.texels.size());
  const std::uint64_t shape =
      base::hashCombine(static_cast<std::uint64_t>(image.width),
                        static_cast<std::uint64_t>(image.height) << 1 | (srgb ? 1 : 0));
  return base::hashBytes(texels, shape);
}

}  // namespace

std::shared_ptr<const Image8> TexturePool::decode(std::string_view bytes, const std::string& name,
                                                  const base::Place& place) {
  base::Diagnostics found;
  const auto size = readImageSize(bytes, name, found);
  if (size) {
    const std::uint64_t texels =
        texels_ + static_cast<std::uint64_t>(size->first) * static_cast<std::uint64_t>(size->second);
    if (texels > base::limitOf(base::Limit::model_texels)) {
      if (!full_)
        base::reportLimit(diagnostics_, base::Limit::model_texels, place,
                          fmt::format("with '{}' the model's textures are too large", name), texels)
            .found = fmt::format("{} texels", texels);
      full_ = true;
      return nullptr;
    }
    texels_ = texels;
    if (auto image = decodeBytes(bytes, 4, name, found))
      return std::make_shared<const Image8>(std::move(*image));
  }
  reportMissing(name, found.empty() ? "it is empty" : found.items().front().message, place);
  return nullptr;
}

void TexturePool::reportMissing(const std::string& name, const std::string& why, const base::Place& place) {
  base::Diagnostic& d =
      diagnostics_.warning(Code::missingModelTexture, place,
                           fmt::format("the model's texture '{}' cannot be used: {}", name, why));
  d.expected = "a .png, .jpg or .tga image in the folder of the model";
  d.hint = "a colour is shown as a magenta checkerboard instead; other maps are left out";
}

std::uint32_t TexturePool::add(std::shared_ptr<const Image8> image, const std::string& name, bool srgb) {
  if (!image) {
    if (!srgb) return kNoRow;
    if (!standIn_) standIn_ = makeStandIn();
    image = standIn_;
  }
  const std::uint64_t content = hashOf(*image, srgb);
  const auto [from, to] = byContent_.equal_range(content);
  for (auto each = from; each != to; ++each) {
    const ModelTexture& known = textures_[each->second];
    if (known.srgb == srgb && known.image->width == image->width && known.image->texels == image->texels)
      return each->second;
  }
  const auto row = static_cast<std::uint32_t>(textures_.size());
  textures_.push_back({name, std::move(image), srgb, content});
  byContent_.emplace(content, row);
  return row;
}

}  // namespace weft::assets
