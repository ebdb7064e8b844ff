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

}  // namespace weft::graph
