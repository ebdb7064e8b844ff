// Figures that sum up how far many values are off.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace weft::theory {

inline double meanOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// The value below which the share `p` of them lies; reorders them.
inline double percentileOf(std::vector<double>& values, double p) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(p * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace weft::theory
