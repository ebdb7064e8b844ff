#include "engine/text/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "engine/text/characters.h"

namespace weft::text {

namespace {

constexpr std::size_t kLongestText = 400, kTextKept = 360;
constexpr std::size_t kLongestWord = 256, kWordKept = 200;

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

std::size_t cutBefore(std::string_view text, std::size_t end) {
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return end;
}

}  // namespace

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
  std::string words;
  if (text.size() > kLongestWord) {
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find(' ', at), text.size());
      if (end - at > kLongestWord)
        words +=
            fmt::format("{}… ({} bytes)", text.substr(at, cutBefore(text.substr(at), kWordKept)), end - at);
      else
        words += text.substr(at, end - at);
      if (end < text.size()) words += ' ';
      at = end + 1;
    }
    if (words.size() <= kLongestText) return words;
    return fmt::format("{}… ({} bytes in all)",
                       std::string_view(words).substr(0, cutBefore(words, kTextKept)), text.size());
  }
  return std::string(text);
}

std::string printableJson(std::string_view json) {
  std::string out;
  out.reserve(json.size());
  while (!json.empty()) {
    const Character c = firstCharacterOf(json);
    if (c.good && c.value >= 0x7F && isControl(c.value))
      out += fmt::format("\\u{:04x}", c.value);
    else
      out += json.substr(0, c.bytes);
    json.remove_prefix(c.bytes);
  }
  return out;
}

}  // namespace weft::text
