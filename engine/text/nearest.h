// The nearest name to a misspelt one, for "did you mean" hints. The work has bounds, because files may be hostile or
// mistaken: a name of more than kLongestName bytes has no nearest one, and only the first 1,000 candidates are compared.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace weft::text {

constexpr std::size_t kLongestName = 128;

// Damerau-Levenshtein distance (adjacent swaps count 1), case-insensitive. Any number above `limit` where it is more; takes
// time of the length times the limit.
std::size_t editDistance(std::string_view a, std::string_view b, std::size_t limit);

// The candidate with the smallest edit distance to `name`, or "" when none is within a third of its length
// (at least 2, at most 8). Of names of fewer than 6 letters two edits are too far, unless the first letter is the same.
std::string nearestName(std::string_view name, std::span<const std::string> candidates);

// "did you mean 'x'?" (or 'y', at most three, when they are as near), or "known: a, b, c" when nothing is
// near and the list is short, or "".
std::string nearestHint(std::string_view name, std::span<const std::string> candidates);

}  // namespace weft::text
