// Pictures from files, as tests want them.
#pragma once

#include "engine/assets/images/image.h"
#include "engine/text/files/file.h"

namespace weft::assets {

inline std::optional<ImageF> loadImage(const std::string& path, text::Diagnostics& diagnostics) {
  const auto bytes = text::readFile(path, diagnostics, text::Code::unreadableImage);
  return bytes ? decodeImage(*bytes, path, diagnostics) : std::nullopt;
}

inline std::optional<ImageF> loadEnvironment(const std::string& path, text::Diagnostics& diagnostics) {
  const auto bytes = text::readFile(path, diagnostics, text::Code::unreadableImage);
  return bytes ? decodeEnvironment(*bytes, path, diagnostics) : std::nullopt;
}

}  // namespace weft::assets
