#include "engine/text/printable.h"

#include <fmt/format.h>

namespace weft::text {

namespace {

bool isControl(std::uint32_t c) {
  return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x61C || c == 0x200E || c == 0x200F ||
         (c >= 0x2028 && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
}

std::string escaped(const Character& c) {
  if (c.good && c.value == '\n') return "\\n";
  if (c.good && c.value == '\r') return "\\r";
  if (c.good && c.value == '\t') return "\\t";
  return c.good && c.value >= 0x80 ? fmt::format("\\u{{{:x}}}", c.value) : fmt::format("\\x{:02x}", c.value);
}

bool isInsideCharacter(std::string_view text, std::size_t at) {
  return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80;
}

}  // namespace

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

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const Character c = firstCharacterOf(text);
    if (!c.good || isControl(c.value))
      out += escaped(c);
    else
      out += text.substr(0, c.bytes);
    text.remove_prefix(c.bytes);
  }
  return out;
}

std::string shortened(std::string_view text) {
  if (text.size() <= 400) return std::string(text);
  std::size_t head = 240, tail = text.size() - 120;
  while (head > 0 && isInsideCharacter(text, head)) --head;
  while (isInsideCharacter(text, tail)) ++tail;
  return fmt::format("{}… ({} bytes) …{}", text.substr(0, head), text.size(), text.substr(tail));
}

std::string counted(std::uint64_t count, std::string_view noun) {
  const bool hisses =
      noun.ends_with('s') || noun.ends_with('x') || noun.ends_with("ch") || noun.ends_with("sh");
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : hisses ? "es" : "s");
}

}  // namespace weft::text
