// The words of an expression: numbers, identifiers, operators. Private to engine/graph/language. Does not:
// know keywords, or report; what is no token of the language comes as one of kind `bad` or as punctuation
// that no grammar accepts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace weft::graph {

struct Token {
  enum class Kind : std::uint8_t { end, number, identifier, punctuation, bad };
  Kind kind = Kind::end;
  std::size_t begin = 0;
  std::string_view text;
  double number = 0;
};

// The token at or after `from`, spaces left out; of kind `end` behind the last. A number that a double cannot
// hold is `bad`. Never cuts a UTF-8 sequence in half.
Token scanToken(std::string_view text, std::size_t from);

// What to write for a size in another format's spelling: "50%", "1920x1080", "512px", and for a number
// with a unit or a color of the web; "" for anything else.
std::string hintForSize(std::string_view text);
// What "scene.width" and the like of other languages is called here, or "".
std::string hintForMember(std::string_view name, std::string_view member);
// What there is in place of a value of "x.mip[i]" and the like.
std::string hintForPart(std::string_view name);

}  // namespace weft::graph
