// What a name of a graph file looks like: identifiers, dotted names, and the words that names may not use.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "engine/text/chars.h"

namespace weft::graph {

using text::isDigit;
using text::isIdentChar;
using text::isIdentStart;
using text::isSpace;
using text::trimmed;

constexpr bool isIdent(std::string_view text) {
  return !text.empty() && isIdentStart(text[0]) && std::all_of(text.begin(), text.end(), isIdentChar);
}

// 0..3 for x y z w, else -1.
constexpr int componentIndex(std::string_view word) {
  constexpr std::string_view kComponents = "xyzw";
  const std::size_t found = word.size() == 1 ? kComponents.find(word[0]) : std::string_view::npos;
  return found == std::string_view::npos ? -1 : static_cast<int>(found);
}

// Words that may stand in no name, because they select a sub-resource or a component after a dot.
constexpr std::array<std::string_view, 8> kReservedWords = {"mip", "layer", "face", "stencil",
                                                            "x",   "y",     "z",    "w"};
constexpr bool isReservedWord(std::string_view word) {
  return std::find(kReservedWords.begin(), kReservedWords.end(), word) != kReservedWords.end();
}

// The dotted name that a text begins with, up to a selector: "ibl.maps" of "ibl.maps.mip[0] as linear". "" when there is none.
constexpr std::string_view dottedNameIn(std::string_view text) {
  std::size_t end = 0;
  for (std::size_t at = 0; at < text.size() && isIdentStart(text[at]); ++at) {
    std::size_t behind = at;
    while (behind < text.size() && isIdentChar(text[behind])) ++behind;
    if (at > 0 && isReservedWord(text.substr(at, behind - at))) break;
    end = at = behind;
    if (at >= text.size() || text[at] != '.') break;
  }
  return text.substr(0, end);
}

}  // namespace weft::graph
