// The texels of a //!TEXTURE block: hexadecimal digits in one of mpv's formats. Formats of 16 and 32 bit floats both
// hold their data as 32 bit floats, those with hf as halves. Does not: write files.
#pragma once

#include <string>
#include <string_view>

#include "engine/convert/mpv/blocks.h"
#include "engine/convert/text/converted.h"

namespace weft::convert {

// Fills `texture.bytes`, or returns what is wrong.
std::string readTextureBytes(MpvTexture& texture, std::string_view hex);

// The picture file that stands for it. Its lowest row is the first of the data, since Weft counts rows from below. A
// texture of three dimensions has no picture: not to be called with one.
std::string imagePathOf(const MpvTexture& texture, const std::string& folder);
ConvertedImage imageOf(const MpvTexture& texture, const std::string& folder);

}  // namespace weft::convert
