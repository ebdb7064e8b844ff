// A picture file as a texture can hold it: the numbers of the file, four channels, bottom row first as OpenGL counts rows.
// Grey becomes equal red, green and blue; a missing alpha is 1. Diagnostics are those of image.h. Does not: decode sRGB
// unless asked, clean what is no colour, or know GL.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/diagnostic.h"

namespace weft::assets {

// What a channel is in the file: .png .jpg .tga of 8 bits, .png of 16 bits, .hdr and .exr.
enum class StoredType : std::uint8_t { byte, word, real };

struct StoredHeader {
  int width = 0, height = 0;
  StoredType type = StoredType::byte;
  friend bool operator==(const StoredHeader&, const StoredHeader&) = default;
};

struct StoredImage {
  StoredHeader header;
  std::vector<std::byte> texels{};  // of 1, 2 or 4 bytes a channel
};

// Walks the file but decodes no texels.
std::optional<StoredHeader> loadStoredHeader(const std::string& path, base::Diagnostics& diagnostics);
std::optional<StoredImage> loadStored(const std::string& path, base::Diagnostics& diagnostics);
// The same for bytes in memory; `name` gives the extension and stands in messages.
std::optional<StoredHeader> readStoredHeader(std::string_view bytes, const std::string& name,
                                             base::Diagnostics& diagnostics);
std::optional<StoredImage> decodeStored(std::string_view bytes, const std::string& name,
                                        base::Diagnostics& diagnostics);

// Red, green and blue of 16 bits decoded from sRGB, as real numbers; alpha stays linear.
StoredImage decodeSrgbWords(const StoredImage& image);

}  // namespace weft::assets
