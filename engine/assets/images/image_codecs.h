// The decoders and encoders behind image.h, one pair per library. Internal to the room.
// `name` is the path as the person wrote it; failures are added with the place set to it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "engine/assets/images/image.h"

namespace weft::assets {

enum class ImageKind : std::uint8_t { unknown, hdr, exr, eight_bit };
ImageKind kindOfName(const std::string& name);

// Adds "cannot read NAME: WHY" as W150, or W152 for sizes.
void reportUnreadable(base::Diagnostics& diagnostics, const std::string& name, const std::string& why);
// True when the size is sound; else adds W152.
bool checkSize(base::Diagnostics& diagnostics, const std::string& name, long long width, long long height);

// Width and height of what decodeBytes would take, without decoding texels.
std::optional<std::pair<int, int>> readImageSize(std::string_view bytes, const std::string& name,
                                                 base::Diagnostics& diagnostics);
// The same for an .hdr and an .exr.
std::optional<std::pair<int, int>> readHdrSize(std::string_view bytes, const std::string& name,
                                               base::Diagnostics& diagnostics);
std::optional<std::pair<int, int>> readExrSize(std::string_view bytes, const std::string& name,
                                               base::Diagnostics& diagnostics);
std::optional<ImageF> decodeHdr(std::string_view bytes, const std::string& name,
                                base::Diagnostics& diagnostics);
std::optional<ImageF> decodeExr(std::string_view bytes, const std::string& name,
                                base::Diagnostics& diagnostics);
std::optional<ImageF> decodeLinear(std::string_view bytes, const std::string& name,
                                   base::Diagnostics& diagnostics);
std::optional<Image8> decodeBytes(std::string_view bytes, int channels, const std::string& name,
                                  base::Diagnostics& diagnostics);
// Whether a file that decodeBytes takes has 16 bits a channel; and those, as stored, RGBA.
bool hasShorts(std::string_view bytes);
std::optional<std::vector<std::uint16_t>> decodeShorts(std::string_view bytes, const std::string& name,
                                                       base::Diagnostics& diagnostics);
// The kind of a file that holds something; unknown after W150 or W151.
ImageKind checkKind(std::string_view bytes, const std::string& name, base::Diagnostics& diagnostics);

}  // namespace weft::assets
