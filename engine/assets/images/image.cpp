#include "engine/assets/images/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "engine/assets/images/half.h"
#include "engine/assets/images/image_codecs.h"
#include "engine/base/files/file.h"

namespace weft::assets {

using base::Code;
using base::Diagnostics;
using base::Place;

namespace {

Place placeOf(const std::string& name) {
  return {std::make_shared<const std::string>(name)};
}

std::string extensionOf(const std::string& name) {
  const std::size_t dot = name.find_last_of('.');
  const std::size_t slash = name.find_last_of('/');
  if (dot == std::string::npos || (slash != std::string::npos && dot < slash)) return "";
  std::string extension = name.substr(dot);
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

void reportUnknownKind(Diagnostics& diagnostics, const std::string& name, std::string expected) {
  base::Diagnostic& d = diagnostics.error(Code::unknownImageKind, placeOf(name),
                                          fmt::format("'{}' is no kind of image that is known", name));
  d.expected = std::move(expected);
  d.found = extensionOf(name).empty() ? "no extension" : extensionOf(name);
}

// Grey, grey-alpha and RGB become RGBA; a missing alpha is 1.
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

// Solid angle of a texel of row `y` of an equirectangular map, in units of one at the equator.
double shareOfRow(const ImageF& image, int y) {
  return std::sin((y + 0.5) * std::numbers::pi / image.height);
}

// Moves what a texel has above kHalfMax to the texels around it, ring by ring, each filled up to kHalfMax in the texel's own
// colour. The light (radiance times solid angle) stays but for what it returns, in the channel that has most.
double spreadLight(ImageF& image, int x, int y) {
  constexpr int kRings = 8;
  const auto at = [&](int column, int row) {
    const int wrapped = (column % image.width + image.width) % image.width;
    return &image.texels[(static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                          static_cast<std::size_t>(wrapped)) *
                         static_cast<std::size_t>(image.channels)];
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

}  // namespace

ImageKind kindOfName(const std::string& name) {
  const std::string extension = extensionOf(name);
  if (extension == ".hdr") return ImageKind::hdr;
  if (extension == ".exr") return ImageKind::exr;
  if (extension == ".png" || extension == ".jpg" || extension == ".jpeg" || extension == ".tga")
    return ImageKind::eight_bit;
  return ImageKind::unknown;
}

void reportUnreadable(Diagnostics& diagnostics, const std::string& name, const std::string& why) {
  diagnostics.error(Code::unreadableImage, placeOf(name),
                    fmt::format("cannot read image '{}': {}", name, why));
}

ImageKind checkKind(std::string_view bytes, const std::string& name, Diagnostics& diagnostics) {
  const ImageKind kind = kindOfName(name);
  if (kind == ImageKind::unknown)
    reportUnknownKind(diagnostics, name, ".hdr, .exr, .png, .jpg, .jpeg or .tga");
  else if (bytes.empty())
    reportUnreadable(diagnostics, name, "the file is empty");
  return bytes.empty() ? ImageKind::unknown : kind;
}

bool checkSize(Diagnostics& diagnostics, const std::string& name, long long width, long long height) {
  const bool tooLarge = width > kMaxImageSide || height > kMaxImageSide ||
                        width * height > static_cast<long long>(kMaxImageTexels);
  if (width >= 1 && height >= 1 && !tooLarge) return true;
  base::Diagnostic& d =
      diagnostics.error(Code::badImageSize, placeOf(name),
                        fmt::format("image '{}' is {}", name, tooLarge ? "too large" : "empty"));
  d.expected = fmt::format("1 to {} texels a side, at most {} in all", kMaxImageSide, kMaxImageTexels);
  d.found = fmt::format("{} x {}", width, height);
  return false;
}

std::optional<ImageF> decodeImage(std::string_view bytes, const std::string& name, Diagnostics& diagnostics) {
  const ImageKind kind = checkKind(bytes, name, diagnostics);
  if (kind == ImageKind::unknown) return {};
  if (kind == ImageKind::hdr) return decodeHdr(bytes, name, diagnostics);
  if (kind == ImageKind::exr) return decodeExr(bytes, name, diagnostics);
  return decodeLinear(bytes, name, diagnostics);
}

std::optional<ImageF> loadImage(const std::string& path, Diagnostics& diagnostics) {
  const std::optional<std::string> bytes = base::readFile(path, diagnostics, Code::unreadableImage);
  if (!bytes) return {};
  return decodeImage(*bytes, path, diagnostics);
}

std::optional<Image8> loadImage8(const std::string& path, int channels, Diagnostics& diagnostics) {
  const std::optional<std::string> bytes = base::readFile(path, diagnostics, Code::unreadableImage);
  if (!bytes) return {};
  if (kindOfName(path) != ImageKind::eight_bit) {
    reportUnknownKind(diagnostics, path, ".png, .jpg, .jpeg or .tga");
    return {};
  }
  return decodeBytes(*bytes, channels, path, diagnostics);
}

std::optional<ImageF> loadEnvironment(const std::string& path, Diagnostics& diagnostics) {
  const std::optional<std::string> bytes = base::readFile(path, diagnostics, Code::unreadableImage);
  if (!bytes) return {};
  return decodeEnvironment(*bytes, path, diagnostics);
}

namespace {

// A picture of a screen as a map of light: white is 1, however bright the sun was.
void warnDisplayReferred(const std::string& name, Diagnostics& diagnostics) {
  base::Diagnostic& d = diagnostics.warning(
      Code::displayReferred, placeOf(name),
      fmt::format("the environment '{}' holds colours of a screen: no light in it is brighter than 1", name));
  d.expected = "radiance, as .hdr and .exr hold it";
  d.found = "sRGB, which was decoded to linear light";
  d.hint = "take an .hdr or .exr of the place, in which the sun is as bright as it was";
}

}  // namespace

std::optional<ImageF> decodeEnvironment(std::string_view bytes, const std::string& name,
                                        Diagnostics& diagnostics) {
  std::optional<ImageF> image = decodeImage(bytes, name, diagnostics);
  if (!image) return {};
  if (kindOfName(name) == ImageKind::eight_bit) warnDisplayReferred(name, diagnostics);
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
          float* texel = &image.texels[(static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                        static_cast<std::size_t>(x)) *
                                       channels];
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
  const std::size_t colours = image.texels.size() / channels * 3;
  base::Diagnostic& d =
      diagnostics.add({.severity = undefined + negative > 0 ? base::Severity::warning : base::Severity::note,
                       .code = Code::texelsReplaced,
                       .message = fmt::format("{} of {} colour values are no radiance and were replaced",
                                              undefined + negative + infinite + tooBright, colours),
                       .place = placeOf(name)});
  d.expected = fmt::format("numbers from 0 to {}", kHalfMax);
  d.found = fmt::format("{} not a number, {} negative (both now 0), {} infinite (now {})", undefined,
                        negative, infinite, kHalfMax);
  if (tooBright > 0)
    d.found += fmt::format(
        ", {} above the range (their light is spread over the texels around them, {:.2g} % of the map's "
        "is lost)",
        tooBright, whole > 0 ? 100 * lost / whole : 0.0);
}

float decodeSrgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float encodeSrgb(float linear) {
  return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

}  // namespace weft::assets
