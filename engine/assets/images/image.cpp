#include "engine/assets/images/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
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
  const ImageKind kind = kindOfName(name);
  if (kind == ImageKind::unknown) {
    reportUnknownKind(diagnostics, name, ".hdr, .exr, .png, .jpg, .jpeg or .tga");
    return {};
  }
  if (bytes.empty()) {
    reportUnreadable(diagnostics, name, "the file is empty");
    return {};
  }
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

std::optional<ImageF> decodeEnvironment(std::string_view bytes, const std::string& name,
                                        Diagnostics& diagnostics) {
  std::optional<ImageF> image = decodeImage(bytes, name, diagnostics);
  if (!image) return {};
  ImageF wide = widenToRgba(std::move(*image));
  for (std::size_t i = 3; i < wide.texels.size(); i += 4) wide.texels[i] = 1;
  sanitizeRadiance(wide, name, diagnostics);
  return wide;
}

void sanitizeRadiance(ImageF& image, const std::string& name, Diagnostics& diagnostics) {
  std::size_t undefined = 0, negative = 0, tooBright = 0;
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
    } else {
      ++tooBright;
      value = kHalfMax;
    }
  }
  if (undefined + negative + tooBright == 0) return;
  const auto channels = static_cast<std::size_t>(image.channels);
  const std::size_t colours = image.texels.size() / channels * std::min<std::size_t>(channels, 3);
  base::Diagnostic& d =
      diagnostics.add({.severity = undefined + negative > 0 ? base::Severity::warning : base::Severity::note,
                       .code = Code::texelsReplaced,
                       .message = fmt::format("{} of {} colour values are no radiance and were replaced",
                                              undefined + negative + tooBright, colours),
                       .place = placeOf(name)});
  d.expected = fmt::format("numbers from 0 to {}", kHalfMax);
  d.found = fmt::format("{} not a number, {} negative (both now 0), {} infinite or above the range (now {})",
                        undefined, negative, tooBright, kHalfMax);
}

float decodeSrgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float encodeSrgb(float linear) {
  return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

}  // namespace weft::assets
