// What stb_image lets pass: files that end early. It fills what is missing with zeros (.hdr at a line's start, .jpg) or
// leaves it uninitialised (.tga). These functions walk a file's structure without decoding it.
// Does not: validate anything that stb_image itself reports. Internal to the room.
#pragma once

#include <string>
#include <string_view>

namespace weft::assets {

// Each returns "" for a complete file, else what is wrong, to stand after "path: ".
std::string checkHdr(std::string_view bytes);
std::string checkJpeg(std::string_view bytes);
std::string checkTga(std::string_view bytes);

}  // namespace weft::assets
