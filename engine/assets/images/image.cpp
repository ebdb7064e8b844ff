#include "engine/assets/images/image.h"

#include <Imath/half.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <numbers>
#include <utility>

#include "assets_sentences.h"
#include "engine/assets/images/image_codecs.h"
#include "engine/text/files/file.h"
#include "engine/text/limits.h"

namespace weft::assets {

using text::Code;
using text::Diagnostics;

namespace {

void reportUnknownKind(Diagnostics& diagnostics, const std::string& name, std::string expected) {
  diagnostics.error(say::unknownImageKind, {name}, name, expected,
                    text::lowerExtension(name).empty() ? "no extension" : text::lowerExtension(name));
}

// Solid angle of a texel of row `y` of an equirectangular map, in units of one at the equator.
double shareOfRow(const ImageF& image, int y) {
  return std::sin((y + 0.5) * std::numbers::pi / image.height);
}

// Moves what a texel has above kHalfMax to the texels around it, ring by ring, each filled up to kHalfMax in the texel's own
// color. The light (radiance times solid angle) stays but for what it returns, in the channel that has most.
double spreadLight(ImageF& image, int x, int y) {
  constexpr int kRings = 8;
  const auto at = [&](int column, int row) {
    return image.texel((column % image.width + image.width) % image.width, row);
  };
  float* texel = at(x, y);
  const double most = std::max({texel[0], texel[1], texel[2]});
  const double color[3] = {texel[0] / most, texel[1] / most, texel[2] / most};
  double left = (most - kHalfMax) * shareOfRow(image, y);
  for (int c = 0; c < 3; ++c) texel[c] = static_cast<float>(color[c] * kHalfMax);
  for (int ring = 1; ring <= kRings && left > 0; ++ring)
    for (int row = std::max(y - ring, 0); row <= std::min(y + ring, image.height - 1) && left > 0; ++row) {
      const int step = row == y - ring || row == y + ring ? 1 : 2 * ring;
      for (int column = x - ring; column <= x + ring && left > 0; column += step) {
        float* other = at(column, row);
        double room = left / shareOfRow(image, row);
        for (int c = 0; c < 3; ++c)
          if (color[c] > 0) room = std::min(room, (kHalfMax - other[c]) / color[c]);
        if (room <= 0) continue;
        for (int c = 0; c < 3; ++c)
          other[c] = std::min(static_cast<float>(other[c] + room * color[c]), kHalfMax);
        left -= room * shareOfRow(image, row);
      }
    }
  return left;
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

// Color is decoded from sRGB, alpha is not.
template <class T>
ImageF linearize(const ImageOf<T>& encoded) {
  static const std::vector<float> kTable = [] {  // of every value that there is
    std::vector<float> values(std::size_t{std::numeric_limits<T>::max()} + 1);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = decodeSrgb(static_cast<float>(i) / static_cast<float>(values.size() - 1));
    return values;
  }();
  ImageF image{encoded.width, encoded.height, encoded.channels, std::vector<float>(encoded.texels.size())};
  const auto channels = static_cast<std::size_t>(encoded.channels);
  for (std::size_t i = 0; i < encoded.texels.size(); ++i) {
    const bool alpha = channels % 2 == 0 && i % channels == channels - 1;
    image.texels[i] = alpha ? static_cast<float>(encoded.texels[i]) / static_cast<float>(kTable.size() - 1)
                            : kTable[encoded.texels[i]];
  }
  return image;
}

// A picture as it stands upright.
template <class T>
std::optional<ImageOf<T>> decodeUpright(std::string_view bytes, int channels, const std::string& name,
                                        Diagnostics& diagnostics) {
  std::optional<ImageOf<T>> stored = decodePicture<T>(bytes, channels, name, diagnostics);
  const int orientation = orientationOf(bytes);
  if (!stored || orientation == 1) return stored;
  const bool mirrorsX = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool mirrorsY = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  const auto size = static_cast<std::size_t>(stored->channels);
  ImageOf<T> image{stored->width, stored->height, stored->channels, std::vector<T>(stored->texels.size())};
  if (orientation >= 5) std::swap(image.width, image.height);
  auto* out = image.texels.data();
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x, out += size) {
      int column = orientation >= 5 ? y : x, row = orientation >= 5 ? x : y;
      if (mirrorsX) column = stored->width - 1 - column;
      if (mirrorsY) row = stored->height - 1 - row;
      std::copy_n(stored->texel(column, row), size, out);
    }
  return image;
}

std::optional<ImageHeader> readHeader(std::string_view bytes, const std::string& name,
                                      Diagnostics& diagnostics) {
  const ImageKind kind = kindOfName(name);
  if (kind == ImageKind::unknown)
    reportUnknownKind(diagnostics, name, ".hdr, .exr, .png, .jpg, .jpeg, .webp or .tga");
  else if (bytes.empty())
    reportUnreadable(diagnostics, name, "the file is empty");
  if (kind == ImageKind::unknown || bytes.empty()) return {};
  if (kind != ImageKind::eight_bit) {
    const auto image = (kind == ImageKind::hdr ? readHdr : readExr)(bytes, name, false, diagnostics);
    if (!image) return {};
    return ImageHeader{image->width, image->height, image->channels, StoredType::real};
  }
  std::optional<ImageHeader> header = readPictureHeader(bytes, name, diagnostics);
  if (header && orientationOf(bytes) >= 5) std::swap(header->width, header->height);
  return header;
}

}  // namespace

ImageF widenToRgba(ImageF image) {
  if (image.channels == 4) return image;
  const std::size_t from = static_cast<std::size_t>(image.channels);
  const std::size_t count = image.texels.size() / from;
  ImageF wide{image.width, image.height, 4, std::vector<float>(count * 4)};
  for (std::size_t i = 0; i < count; ++i) {
    const float* in = &image.texels[i * from];
    float* out = &wide.texels[i * 4];
    out[0] = in[0];
    out[1] = from >= 3 ? in[1] : in[0];
    out[2] = from >= 3 ? in[2] : in[0];
    out[3] = from == 2 ? in[1] : 1.0f;
  }
  return wide;
}

ImageKind kindOfName(const std::string& name) {
  const std::string extension = text::lowerExtension(name);
  if (extension == ".hdr") return ImageKind::hdr;
  if (extension == ".exr") return ImageKind::exr;
  for (const char* picture : {".png", ".jpg", ".jpeg", ".webp", ".tga"})
    if (extension == picture) return ImageKind::eight_bit;
  return ImageKind::unknown;
}

void reportUnreadable(Diagnostics& diagnostics, const std::string& name, const std::string& why) {
  diagnostics.error(say::cannotReadImage, {name}, name, why);
}

bool checkSize(Diagnostics& diagnostics, const std::string& name, long long width, long long height,
               int texel) {
  const bool empty = std::min(width, height) < 1, never = empty || std::max(width, height) > kMaxImageSide;
  const std::uint64_t most = text::raised(kMaxImageBytes),
                      bytes = never ? ~0ull : static_cast<std::uint64_t>(width * height * texel);
  if (bytes > most)
    diagnostics.error(say::badImage, {name}, name, empty ? "empty" : "too large", kMaxImageSide,
                      most / static_cast<unsigned>(texel), width, height,
                      text::hintToRaise(kMaxImageBytes, bytes));
  return bytes <= most;
}

std::optional<ImageHeader> loadHeader(const std::string& path, Diagnostics& diagnostics) {
  const auto bytes = text::readFile(path, diagnostics, Code::unreadableImage);
  return bytes ? readHeader(*bytes, path, diagnostics) : std::nullopt;
}

std::optional<ImageF> decodeImage(std::string_view bytes, const std::string& name, Diagnostics& diagnostics) {
  const std::optional<ImageHeader> header = readHeader(bytes, name, diagnostics);
  if (!header || !checkSize(diagnostics, name, header->width, header->height)) return {};
  const auto linear = [](const auto& encoded) {
    return encoded ? std::optional(linearize(*encoded)) : std::nullopt;
  };
  if (header->type == StoredType::byte)
    return linear(decodeUpright<std::uint8_t>(bytes, 0, name, diagnostics));
  if (header->type == StoredType::word)
    return linear(decodeUpright<std::uint16_t>(bytes, 0, name, diagnostics));
  return (kindOfName(name) == ImageKind::hdr ? readHdr : readExr)(bytes, name, true, diagnostics);
}

std::optional<Image8> loadImage8(const std::string& path, int channels, Diagnostics& diagnostics) {
  const std::optional<std::string> bytes = text::readFile(path, diagnostics, Code::unreadableImage);
  if (!bytes) return {};
  if (kindOfName(path) != ImageKind::eight_bit) {
    reportUnknownKind(diagnostics, path, ".png, .jpg, .jpeg, .webp or .tga");
    return {};
  }
  return readHeader(*bytes, path, diagnostics)
             ? decodeUpright<std::uint8_t>(*bytes, channels, path, diagnostics)
             : std::nullopt;
}

std::optional<ImageF> decodeEnvironment(std::string_view bytes, const std::string& name,
                                        Diagnostics& diagnostics) {
  std::optional<ImageF> image = decodeImage(bytes, name, diagnostics);
  if (!image) return {};
  if (kindOfName(name) == ImageKind::eight_bit) diagnostics.warning(say::displayReferred, {name}, name);
  ImageF wide = widenToRgba(std::move(*image));
  for (std::size_t i = 3; i < wide.texels.size(); i += 4) wide.texels[i] = 1;
  sanitizeRadiance(wide, name, diagnostics);
  return wide;
}

void sanitizeRadiance(ImageF& image, const std::string& name, Diagnostics& diagnostics) {
  std::size_t undefined = 0, negative = 0, infinite = 0, tooBright = 0;
  assert(image.channels == 3 || image.channels == 4);
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.texels.size(); ++i) {
    float& value = image.texels[i];
    if (image.channels == 4 && i % 4 == 3) continue;
    if (value >= 0 && value <= kHalfMax) continue;
    if (std::isnan(value)) {
      ++undefined;
      value = 0;
    } else if (value < 0) {
      ++negative;
      value = 0;
    } else if (std::isinf(value)) {
      ++infinite;
      value = kHalfMax;
    } else {
      ++tooBright;
    }
  }
  if (undefined + negative + infinite + tooBright == 0) return;

  double lost = 0, whole = 0;
  if (tooBright > 0) {
    // The share is that of the brightest channel of each texel, weighted by solid angle.
    for (int pass = 0; pass < 2; ++pass)
      for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
          const float* const texel = image.texel(x, y);
          const float most = std::max({texel[0], texel[1], texel[2]});
          if (pass == 0)
            whole += static_cast<double>(most) * shareOfRow(image, y);
          else if (most > kHalfMax)
            lost += spreadLight(image, x, y);
        }
  }

  // Light that was only spread is nothing to tell of.
  constexpr double kNoLoss = 5e-4;
  if (undefined + negative + infinite == 0 && lost < kNoLoss * whole) return;
  const std::size_t colors = image.texels.size() / channels * 3;
  std::string found = fmt::format("{} not a number, {} negative (both now 0), {} infinite (now {})",
                                  undefined, negative, infinite, kHalfMax);
  if (tooBright > 0)
    found += fmt::format(
        ", {} above the range (their light is spread over the texels around them, {:.2g} % of the map's "
        "is lost)",
        tooBright, whole > 0 ? 100 * lost / whole : 0.0);
  diagnostics.add(undefined + negative > 0 ? text::Severity::warning : text::Severity::note,
                  say::texelsReplaced, {name}, undefined + negative + infinite + tooBright, colors, kHalfMax,
                  found);
}

float decodeSrgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

std::optional<StoredImage> loadStored(const std::string& path, bool srgb, Diagnostics& diagnostics) {
  const auto bytes = text::readFile(path, diagnostics, Code::unreadableImage);
  auto header = bytes ? readHeader(*bytes, path, diagnostics) : std::nullopt;
  if (!header) return {};
  if (srgb && header->type == StoredType::word) header->type = StoredType::real;
  const auto stored = [&](const auto& picture) -> std::optional<StoredImage> {
    if (!picture) return {};
    return StoredImage{*header, turnedOver(std::span(picture->texels), header->height)};
  };
  if (header->type == StoredType::byte)
    return stored(decodeUpright<std::uint8_t>(*bytes, 4, path, diagnostics));
  if (header->type == StoredType::word)
    return stored(decodeUpright<std::uint16_t>(*bytes, 4, path, diagnostics));
  std::optional<ImageF> picture = decodeImage(*bytes, path, diagnostics);
  if (picture) picture = widenToRgba(std::move(*picture));
  return stored(picture);
}

std::optional<EnvironmentMap> loadEnvironmentMap(const std::string& path, text::Diagnostics& diagnostics,
                                                 const std::stop_token& stop) try {
  std::optional<ImageF> image;
  {
    const auto bytes = text::readFile(path, diagnostics, text::Code::unreadableImage, {}, stop);
    if (!bytes) return {};
    image = decodeEnvironment(*bytes, path, diagnostics);
  }
  if (!image || stop.stop_requested()) return {};
  return toEnvironmentMap(*std::move(image));
} catch (const std::exception& error) {  // out of memory
  reportUnreadable(diagnostics, path, fmt::format("decoding failed ({})", error.what()));
  return {};
}

bool isEnvironmentName(const std::string& name) {
  const ImageKind kind = kindOfName(name);
  return kind == ImageKind::hdr || kind == ImageKind::exr;
}

EnvironmentMap toEnvironmentMap(ImageF image) {
  image = widenToRgba(std::move(image));
  EnvironmentMap map{static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(image.height), {}};
  map.texels.resize(image.texels.size());
  std::ranges::transform(image.texels, map.texels.begin(), imath_float_to_half);
  return map;
}

}  // namespace weft::assets
