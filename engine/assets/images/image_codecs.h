// The decoders behind image.h, one file per library. Internal to the room. `name` is the path as the person wrote it; failures are
// added with the place set to it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/assets/images/image.h"

namespace weft::assets {

enum class ImageKind : std::uint8_t { unknown, hdr, exr, eight_bit };
ImageKind kindOfName(const std::string& name);
// Adds "cannot read NAME: WHY" as W150.
void reportUnreadable(text::Diagnostics& diagnostics, const std::string& name, const std::string& why);
// True when the size is sound, with that many bytes a texel; else adds W152.
bool checkSize(text::Diagnostics& diagnostics, const std::string& name, long long width, long long height,
               int texel = 16);

// Of .png, .jpg, .webp and .tga.
std::optional<ImageHeader> readPictureHeader(std::string_view bytes, const std::string& name,
                                             text::Diagnostics& diagnostics);
// How a picture lies as the camera held it, 1 to 8 (JEITA CP-3451, Exif 2.3, tag 0x0112); 1, as stored, where it does not say.
int orientationOf(std::string_view bytes);
// As stored, of bytes whose header was read. `channels` 1 to 4, or 0 for what the file has; T is std::uint8_t or std::uint16_t.
template <class T>
std::optional<ImageOf<T>> decodePicture(std::string_view bytes, int channels, const std::string& name,
                                        text::Diagnostics& diagnostics);
// Without texels unless `decodes`; the scanlines of an .hdr are walked also then.
std::optional<ImageF> readHdr(std::string_view bytes, const std::string& name, bool decodes,
                              text::Diagnostics& diagnostics);
std::optional<ImageF> readExr(std::string_view bytes, const std::string& name, bool decodes,
                              text::Diagnostics& diagnostics);

// Gray, gray-alpha and RGB become RGBA; a missing alpha is 1.
ImageF widenToRgba(ImageF image);

}  // namespace weft::assets
