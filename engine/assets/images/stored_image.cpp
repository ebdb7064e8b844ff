#include "engine/assets/images/stored_image.h"

#include <cassert>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>

#include "engine/assets/images/image_codecs.h"
#include "engine/base/files/file.h"

namespace weft::assets {

using base::Diagnostics;

namespace {

constexpr std::size_t kStoredChannels = 4;

std::optional<std::string> readPicture(const std::string& path, Diagnostics& diagnostics) {
  return base::readFile(path, diagnostics, base::Code::unreadableImage);
}

// Rows of `texels`, top row first, into bytes with the bottom row first.
template <class T>
std::vector<std::byte> turnedOver(std::span<const T> texels, int height) {
  const auto bytes = std::as_bytes(texels);
  const std::size_t rows = static_cast<std::size_t>(height), row = bytes.size() / rows;
  std::vector<std::byte> out(bytes.size());
  for (std::size_t y = 0; y < rows; ++y) std::memcpy(&out[(rows - 1 - y) * row], &bytes[y * row], row);
  return out;
}

std::vector<float> withAlpha(const std::vector<float>& rgb) {
  std::vector<float> rgba(rgb.size() / 3 * kStoredChannels, 1.0f);
  for (std::size_t i = 0; i * 3 < rgb.size(); ++i)
    std::memcpy(&rgba[i * kStoredChannels], &rgb[i * 3], 3 * sizeof(float));
  return rgba;
}

}  // namespace

std::optional<StoredHeader> readStoredHeader(std::string_view bytes, const std::string& name,
                                             Diagnostics& diagnostics) {
  const ImageKind kind = checkKind(bytes, name, diagnostics);
  if (kind == ImageKind::unknown) return {};
  const auto size = kind == ImageKind::hdr   ? readHdrSize(bytes, name, diagnostics)
                    : kind == ImageKind::exr ? readExrSize(bytes, name, diagnostics)
                                             : readImageSize(bytes, name, diagnostics);
  if (!size) return {};
  const StoredType type = kind != ImageKind::eight_bit ? StoredType::real
                          : hasShorts(bytes)           ? StoredType::word
                                                       : StoredType::byte;
  return StoredHeader{size->first, size->second, type};
}

std::optional<StoredImage> decodeStored(std::string_view bytes, const std::string& name,
                                        Diagnostics& diagnostics) {
  const std::optional<StoredHeader> header = readStoredHeader(bytes, name, diagnostics);
  if (!header) return {};
  StoredImage image{*header};
  if (header->type == StoredType::byte) {
    const auto picture = decodeBytes(bytes, static_cast<int>(kStoredChannels), name, diagnostics);
    if (!picture) return {};
    image.texels = turnedOver(std::span(picture->texels), header->height);
  } else if (header->type == StoredType::word) {
    const auto words = decodeShorts(bytes, name, diagnostics);
    if (!words) return {};
    image.texels = turnedOver(std::span(*words), header->height);
  } else {
    const bool hdr = kindOfName(name) == ImageKind::hdr;
    auto picture = hdr ? decodeHdr(bytes, name, diagnostics) : decodeExr(bytes, name, diagnostics);
    if (!picture) return {};
    if (picture->channels == 3) picture->texels = withAlpha(picture->texels);
    image.texels = turnedOver(std::span<const float>(picture->texels), header->height);
  }
  return image;
}

std::optional<StoredHeader> loadStoredHeader(const std::string& path, Diagnostics& diagnostics) {
  const auto bytes = readPicture(path, diagnostics);
  return bytes ? readStoredHeader(*bytes, path, diagnostics) : std::nullopt;
}

std::optional<StoredImage> loadStored(const std::string& path, Diagnostics& diagnostics) {
  const auto bytes = readPicture(path, diagnostics);
  return bytes ? decodeStored(*bytes, path, diagnostics) : std::nullopt;
}

StoredImage decodeSrgbWords(const StoredImage& image) {
  assert(image.header.type == StoredType::word);
  const std::size_t count = image.texels.size() / sizeof(std::uint16_t);
  StoredImage out{{image.header.width, image.header.height, StoredType::real}};
  out.texels.resize(count * sizeof(float));
  for (std::size_t i = 0; i < count; ++i) {
    std::uint16_t word = 0;
    std::memcpy(&word, &image.texels[i * sizeof word], sizeof word);
    const float encoded = static_cast<float>(word) / 65535.0f;
    const float value = i % kStoredChannels == 3 ? encoded : decodeSrgb(encoded);
    std::memcpy(&out.texels[i * sizeof value], &value, sizeof value);
  }
  return out;
}

}  // namespace weft::assets
