// The nearest name to a misspelt one, for "did you mean" hints.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft::base {

// Damerau-Levenshtein distance (adjacent swaps count 1), case-insensitive.
std::size_t editDistance(std::string_view a, std::string_view b);

// The candidate with the smallest edit distance to `name`, or "" when none is within a third of its length (at least 2).
std::string nearestName(std::string_view name, std::span<const std::string> candidates);

// "did you mean 'x'?" (or 'y', at most three, when they are as near), or "known: a, b, c" when nothing is near and the list is short, or "".
std::string nearestHint(std::string_view name, std::span<const std::string> candidates);

}  // namespace weft::base
