// What a name of a graph file looks like: identifiers, dotted names, and the words that names may not use.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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

// Dotted names and the suffixes that stand for them: `--set`, `--disable` and "set" of files take any unique
// suffix of a name; elsewhere in files names are whole.

// True when the dotted `name` is `suffix` or ends in ".suffix".
bool hasSuffix(std::string_view name, std::string_view suffix);

// The indices of the names that `wanted` may mean: that of the equal name, else those of all names that end in it.
std::vector<std::size_t> suffixMatches(std::span<const std::string> names, std::string_view wanted);

// The longest suffix of both.
std::string commonSuffix(std::string_view a, std::string_view b);

// The name that ends in `wanted`, else in its last part, else the nearest of the names and of their last parts, as a hint; ""
// when nothing is near and the list is long.
std::string suffixHint(std::string_view wanted, std::span<const std::string> names);

}  // namespace weft::graph
