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
  // Each row as differences to the texel at the left; stb would try all five filters for each.
  [[maybe_unused]] static const int filter = stbi_write_force_png_filter = 1;
  std::string bytes;
  const int done =
      stbi_write_png_to_func(appendTo, &bytes, width, height, channels, texels.data(), width * channels);
  return done ? bytes : std::string();
}

}  // namespace weft::assets
