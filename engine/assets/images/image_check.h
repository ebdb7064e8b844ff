// What stb_image and tinyexr do not survive or let pass. Files that end early: stb_image fills what is
// missing with zeros (.hdr at a line's start, .jpg) or leaves it uninitialised (.tga). Huffman tables of more
// than 256 codes in a .jpg: stb_image writes beyond its arrays (the packaged version of 2022-09 does; found
// by the fuzz test). Attributes of an .exr of a wrong size or value: tinyexr asserts. These functions walk a
// file's structure without decoding. Does not: validate what the libraries themselves report. Internal to the
// room.
#pragma once

#include <string>
#include <string_view>

namespace weft::assets {

// Each returns "" for a complete file, else what is wrong, to stand after "path: ".
std::string checkHdr(std::string_view bytes);
// A file that stb_image takes for a JPEG; checkJpeg comes before any call to stb_image with it.
bool isJpeg(std::string_view bytes);
std::string checkJpeg(std::string_view bytes);
std::string checkTga(std::string_view bytes);
// Also refuses what is legal and not read: several parts, deep data, tiles (tinyexr
// leaks and strays in damaged ones), subsampled channels, compressions beyond PIZ.
std::string checkExr(std::string_view bytes);

}  // namespace weft::assets
