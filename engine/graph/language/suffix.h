// Dotted names and the suffixes that stand for them: `--set`, `--disable` and "set" of files take any unique
// suffix of a name; elsewhere in files names are whole.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft::graph {

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
