#include "engine/assets/images/encode_png.h"

#include <stb/stb_image_write.h>

#include <cassert>
#include <cstddef>

namespace weft::assets {

namespace {

void appendTo(void* out, void* bytes, int count) {
  static_cast<std::string*>(out)->append(static_cast<const char*>(bytes), static_cast<std::size_t>(count));
}

}  // namespace

std::string encodePng8(int width, int height, int channels, std::span<const std::uint8_t> texels) {
  assert(width > 0 && height > 0 && channels >= 1 && channels <= 4);
  assert(texels.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                              static_cast<std::size_t>(channels));
  std::string bytes;
  const int done =
      stbi_write_png_to_func(appendTo, &bytes, width, height, channels, texels.data(), width * channels);
  return done ? bytes : std::string();
}

}  // namespace weft::assets
