#include "engine/base/nearest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <limits>

namespace weft::base {

std::size_t editDistance(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  const std::size_t width = b.size() + 1;
  std::vector<std::size_t> before(width), last(width), now(width);
  for (std::size_t j = 0; j < width; ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j < width; ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped =
          i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(now);
  }
  return last[b.size()];
}

std::string nearestName(std::string_view name, std::span<const std::string> candidates) {
  const std::size_t limit = std::max<std::size_t>(2, name.size() / 3);
  std::size_t best = std::numeric_limits<std::size_t>::max();
  std::string found;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = editDistance(name, candidate);
    if (distance < best) {
      best = distance;
      found = candidate;
    }
  }
  return best <= limit && best < name.size() ? found : std::string();
}

std::string nearestHint(std::string_view name, std::span<const std::string> candidates) {
  if (const std::string nearest = nearestName(name, candidates); !nearest.empty()) {
    // Others as near, at most two: "rgba16q" may be "rgba16" or "rgba16f".
    std::string all = fmt::format("'{}'", nearest);
    const std::size_t distance = editDistance(name, nearest);
    int more = 0;
    for (const std::string& candidate : candidates)
      if (distance <= 2 && more < 2 && candidate != nearest && editDistance(name, candidate) == distance) {
        all += fmt::format(" or '{}'", candidate);
        ++more;
      }
    return fmt::format("did you mean {}?", all);
  }
  if (!candidates.empty() && candidates.size() <= 12)
    return fmt::format("known: {}", fmt::join(candidates, ", "));
  return {};
}

}  // namespace weft::base
