// The #if, #ifdef, #else and #endif of a text, line by line: which one leaves a declaration out, which one is never closed.
// Does not: decide conditions, or join lines that end in a backslash.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace weft::gl {

struct Conditional {
  std::uint32_t textLine = 0;  // of its #if, from 1
  std::string text;            // "#ifdef HAS_GLOW"
};

// The innermost conditional around the first line that declares `name` as an input, output, uniform or block, or "".
// "#else of #ifdef HAS_GLOW" where it stands behind that.
std::string conditionalAround(std::string_view name, std::string_view text);

// The last conditional that is open where the text ends.
std::optional<Conditional> unterminatedConditional(std::string_view text);

// Whether `word` stands in a line by itself, and not as a part of another word.
bool mentionsWord(std::string_view line, std::string_view word);

}  // namespace weft::gl
