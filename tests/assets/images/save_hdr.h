// A picture as a Radiance file, RGBE with 3 channels.
#pragma once

#include <stb/stb_image_write.h>

#include <string>

#include "engine/assets/images/image.h"
#include "engine/text/files/file.h"

namespace weft::assets {

inline bool saveHdr(const std::string& path, const ImageF& image, text::Diagnostics& diagnostics) {
  std::string bytes;
  const auto append = [](void* out, void* more, int count) {
    static_cast<std::string*>(out)->append(static_cast<const char*>(more), static_cast<std::size_t>(count));
  };
  stbi_write_hdr_to_func(append, &bytes, image.width, image.height, image.channels, image.texels.data());
  return text::writeFile(path, bytes, diagnostics);
}

}  // namespace weft::assets
