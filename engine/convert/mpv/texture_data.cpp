#include "engine/convert/mpv/texture_data.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <optional>

#include "engine/assets/images/half.h"

namespace weft::convert {

namespace {

enum class Kind : std::uint8_t { byte, word, half, real };

struct Format {
  std::size_t channels = 0, bytes = 0;  // bytes: of a channel
  Kind kind = Kind::byte;
};

std::optional<Format> formatOf(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, std::size_t>, 4> kChannels{
      {{"rgba", 4}, {"rgb", 3}, {"rg", 2}, {"r", 1}}};
  for (const auto& [prefix, channels] : kChannels) {
    if (!name.starts_with(prefix)) continue;
    const std::string_view rest = name.substr(prefix.size());
    if (rest == "8") return Format{channels, 1, Kind::byte};
    if (rest == "16") return Format{channels, 2, Kind::word};
    if (rest == "16hf") return Format{channels, 2, Kind::half};
    if (rest == "16f" || rest == "32f") return Format{channels, 4, Kind::real};
    return std::nullopt;
  }
  return std::nullopt;
}

int digitOf(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

float numberAt(const MpvTexture& texture, const Format& format, std::size_t at) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < format.bytes; ++i) bits |= std::uint32_t{texture.bytes[at + i]} << (8 * i);
  switch (format.kind) {
    case Kind::byte:
      return static_cast<float>(bits) / 255.0f;
    case Kind::word:
      return static_cast<float>(bits) / 65535.0f;
    case Kind::half:
      return assets::halfToFloat(static_cast<std::uint16_t>(bits));
    case Kind::real:
      break;
  }
  return std::bit_cast<float>(bits);
}

}  // namespace

std::string readTextureBytes(MpvTexture& texture, std::string_view hex) {
  if (texture.format.empty()) return fmt::format("the texture '{}' has no //!FORMAT", texture.name);
  const auto format = formatOf(texture.format);
  if (!format)
    return fmt::format(
        "the texture '{}' has the format '{}', which is none of r rg rgb rgba with 8, 16, 16f, 16hf or 32f",
        texture.name, texture.format.substr(0, 20));
  const std::uint64_t texels =
      std::uint64_t(texture.size[0]) * std::uint64_t(texture.size[1]) * std::uint64_t(texture.size[2]);
  const std::uint64_t expected = texels * format->channels * format->bytes;
  if (hex.size() != 2 * expected)
    return fmt::format("the texture '{}' has {} hexadecimal digits, and {} x {} x {} texels of {} take {}",
                       texture.name, hex.size(), texture.size[0], texture.size[1], texture.size[2],
                       texture.format, 2 * expected);
  texture.bytes.resize(expected);
  for (std::size_t i = 0; i < texture.bytes.size(); ++i) {
    const int high = digitOf(hex[2 * i]), low = digitOf(hex[2 * i + 1]);
    if (high < 0 || low < 0)
      return fmt::format("the texture '{}' has digits that are not hexadecimal", texture.name);
    texture.bytes[i] = static_cast<std::uint8_t>(16 * high + low);
  }
  return {};
}

std::string imagePathOf(const MpvTexture& texture, const std::string& folder) {
  const bool bytes = formatOf(texture.format)->kind == Kind::byte;
  return fmt::format("{}/{}.{}", folder, texture.name, bytes ? "png" : "exr");
}

ConvertedImage imageOf(const MpvTexture& texture, const std::string& folder) {
  const Format format = *formatOf(texture.format);
  const bool bytes = format.kind == Kind::byte;
  ConvertedImage image{
      .path = imagePathOf(texture, folder), .width = texture.size[0], .height = texture.size[1]};
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  for (std::size_t row = 0; row < height; ++row)
    for (std::size_t x = 0; x < width; ++x)
      for (std::size_t c = 0; c < 4; ++c) {
        const std::size_t texel = (height - 1 - row) * width + x;
        const float number = c < format.channels
                                 ? numberAt(texture, format, (texel * format.channels + c) * format.bytes)
                                 : (c == 3 ? 1.0f : 0.0f);
        if (bytes)
          image.bytes.push_back(static_cast<std::uint8_t>(std::lround(number * 255.0f)));
        else
          image.floats.push_back(number);
      }
  return image;
}

}  // namespace weft::convert
