// Text for messages. Text from files, drivers and command lines is made safe to print: nothing in it can move a terminal's cursor,
// color the terminal, turn the direction of text, or begin a line that looks like one of Weft's own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace weft::text {

// A character of UTF-8.
struct Character {
  std::uint32_t value = 0;
  std::size_t bytes = 1;
  bool good = false;  // else one byte that is no UTF-8
};
// The first of a text that is not empty (RFC 3629: no overlong forms, no surrogates).
Character firstCharacterOf(std::string_view text);

// One line: control characters (C0, DEL, C1), line and paragraph separators, marks that turn the direction of
// text, and bytes that are no UTF-8 become `\n`, `\x1b`, `\u{202e}`; everything else stays.
std::string printable(std::string_view text);

// At most 400 bytes of `text`: of a longer one the beginning, "… (1000 bytes) …" and the end. Cuts between characters only.
std::string shortened(std::string_view text);

// "1 pass", "2 passes". `noun` in the singular: "case", "pass", "order".
std::string counted(std::uint64_t count, std::string_view noun);

}  // namespace weft::text
