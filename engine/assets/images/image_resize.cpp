#include "engine/assets/images/image_resize.h"

#include <stb/stb_image_resize.h>

#include <cassert>

namespace weft::assets {

Image8 resize(const Image8& image, int width, int height, bool srgb) {
  assert(image.channels == 4);
  Image8 out{width, height, 4, {}};
  out.texels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  // Alpha is a mask or nothing: colour is not weighted by it.
  [[maybe_unused]] const int good = stbir_resize_uint8_generic(
      image.texels.data(), image.width, image.height, 0, out.texels.data(), width, height, 0, 4, 3,
      STBIR_FLAG_ALPHA_PREMULTIPLIED, STBIR_EDGE_WRAP, STBIR_FILTER_DEFAULT,
      srgb ? STBIR_COLORSPACE_SRGB : STBIR_COLORSPACE_LINEAR, nullptr);
  assert(good);
  return out;
}

}  // namespace weft::assets
