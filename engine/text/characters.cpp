#include "engine/text/characters.h"

#include <fmt/format.h>

namespace weft::text {

Character firstCharacterOf(std::string_view text) {
  const auto byteAt = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byteAt(0);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return {lead, 1, false};
  std::uint32_t value = lead & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byteAt(i) & 0xC0) != 0x80) return {lead, 1, false};
    value = value << 6 | (byteAt(i) & 0x3Fu);
  }
  const bool good = value >= kLeast[bytes] && value <= 0x10FFFF && (value < 0xD800 || value > 0xDFFF);
  return good ? Character{value, bytes, true} : Character{lead, 1, false};
}

std::string describeStray(std::string_view text) {
  const Character c = firstCharacterOf(text);
  return c.good ? fmt::format("'{}' (U+{:04X}) has no meaning here", text.substr(0, c.bytes), c.value)
                : fmt::format("the byte 0x{:02X} is not UTF-8", c.value);
}

}  // namespace weft::text
