#include "engine/assets/images/encode_png.h"

#include <array>
#include <cassert>
#include <cstddef>
#include <string_view>
#include <vector>

#include "engine/assets/images/deflate.h"

namespace weft::assets {

namespace {

// "PNG (Portable Network Graphics) Specification", W3C 2003, annex D.
std::uint32_t crcOf(std::string_view bytes) {
  static const auto table = [] {
    std::array<std::uint32_t, 256> made{};
    for (std::uint32_t n = 0; n < made.size(); ++n) {
      made[n] = n;
      for (int bit = 0; bit < 8; ++bit)
        made[n] = (made[n] & 1u) != 0 ? 0xedb88320u ^ made[n] >> 1 : made[n] >> 1;
    }
    return made;
  }();
  std::uint32_t crc = ~std::uint32_t{0};
  for (const char byte : bytes) crc = table[(crc ^ static_cast<std::uint8_t>(byte)) & 0xff] ^ crc >> 8;
  return ~crc;
}

void appendNumber(std::string& out, std::size_t number) {
  for (const unsigned shift : {24u, 16u, 8u, 0u}) out += static_cast<char>(number >> shift & 0xff);
}

void appendChunk(std::string& out, const char* name, std::string_view data) {
  appendNumber(out, data.size());
  const std::size_t begin = out.size();
  out.append(name).append(data);
  appendNumber(out, crcOf(std::string_view(out).substr(begin)));
}

}  // namespace

std::string encodePng8(int width, int height, int channels, std::span<const std::uint8_t> texels) {
  assert(width > 0 && height > 0 && channels >= 1 && channels <= 4);
  const auto bytes_per_texel = static_cast<std::size_t>(channels);
  const std::size_t row = static_cast<std::size_t>(width) * bytes_per_texel;
  assert(texels.size() == row * static_cast<std::size_t>(height));
  // Each row as differences to the texel at the left: filter 1.
  std::vector<std::uint8_t> filtered;
  filtered.reserve(texels.size() + static_cast<std::size_t>(height));
  for (const std::uint8_t* line = texels.data(); line != texels.data() + texels.size(); line += row) {
    filtered.push_back(1);
    filtered.insert(filtered.end(), line, line + bytes_per_texel);
    for (std::size_t i = bytes_per_texel; i < row; ++i)
      filtered.push_back(static_cast<std::uint8_t>(line[i] - line[i - bytes_per_texel]));
  }
  constexpr std::array<char, 4> kColorTypes = {0, 4, 2, 6};  // grey, grey and alpha, RGB, RGBA
  std::string header;
  appendNumber(header, static_cast<std::size_t>(width));
  appendNumber(header, static_cast<std::size_t>(height));
  header += {8, kColorTypes[bytes_per_texel - 1], 0, 0, 0};
  std::string out = "\x89PNG\r\n\x1a\n";
  appendChunk(out, "IHDR", header);
  appendChunk(out, "IDAT", deflateFast(filtered));
  appendChunk(out, "IEND", {});
  return out;
}

}  // namespace weft::assets
