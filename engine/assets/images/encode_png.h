// A picture as the bytes of a PNG file. Does not: write files (image.h does).
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace weft::assets {

// Empty when it cannot be encoded.
std::string encodePng8(int width, int height, int channels, std::span<const std::uint8_t> texels);

}  // namespace weft::assets
