// Characters of UTF-8, and what is said of one that stands where no language has it: a quote of a word processor, a
// space of a web page. Does not: normalise, or know what is printed in how many columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace weft::base {

struct Character {
  std::uint32_t value = 0;
  std::size_t bytes = 1;
  bool good = false;  // else one byte that is no UTF-8
};

// The first character of a text that is not empty (RFC 3629: no overlong forms, no surrogates).
Character firstCharacterOf(std::string_view text);

// Of the character that a text begins with, and that is not ASCII: "'“' (U+201C) is no plain quote", "U+00A0 is a space that
// only looks like one". What to do about it is the hint, "" for one that is neither.
struct StrayCharacter {
  std::string message, hint;
};
StrayCharacter describeStray(std::string_view text);

}  // namespace weft::base
