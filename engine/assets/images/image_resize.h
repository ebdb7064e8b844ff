// Pictures scaled to another size, by stb_image_resize.
#pragma once

#include "engine/assets/images/image.h"

namespace weft::assets {

// `image` with 4 channels, `width` x `height` texels over 0; repeated at its edges. `srgb`: colour is averaged as light, alpha
// never is encoded.
Image8 resize(const Image8& image, int width, int height, bool srgb);

}  // namespace weft::assets
