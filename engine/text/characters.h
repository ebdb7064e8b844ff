// Characters of UTF-8, and what is said of one that no language has where it stands.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace weft::text {

struct Character {
  std::uint32_t value = 0;
  std::size_t bytes = 1;
  bool good = false;  // else one byte that is no UTF-8
};

// The first character of a text that is not empty (RFC 3629: no overlong forms, no surrogates).
Character firstCharacterOf(std::string_view text);

// Of the character that a text begins with, and that is not ASCII: "'“' (U+201C) has no meaning here".
std::string describeStray(std::string_view text);

}  // namespace weft::text
