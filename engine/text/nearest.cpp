#include "engine/text/nearest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include "engine/text/chars.h"

namespace weft::text {

namespace {

constexpr std::size_t kMaxCandidates = 1000, kMaxDistance = 8;

// Two edits make another word of a short one, unless it begins the same: "mul" is not "all", "round" not "count".
bool isFar(std::string_view name, std::string_view candidate, std::size_t distance) {
  return distance > 1 && name.size() < 6 && lower(name[0]) != lower(candidate[0]);
}

struct Nearest {
  std::size_t index = 0, distance = 0;
};

// The first of the nearest candidates, when it is near enough.
std::optional<Nearest> findNearest(std::string_view name, std::span<const std::string> candidates) {
  if (name.empty() || name.size() > kLongestName) return std::nullopt;
  std::size_t limit = std::min(std::clamp<std::size_t>(name.size() / 3, 2, kMaxDistance), name.size() - 1);
  std::optional<Nearest> found;
  for (std::size_t i = 0; i < std::min(candidates.size(), kMaxCandidates); ++i) {
    const std::size_t distance = editDistance(name, candidates[i], limit);
    if (distance > limit || isFar(name, candidates[i], distance)) continue;
    found = {i, distance};
    if (distance == 0) break;
    limit = distance - 1;
  }
  return found;
}

}  // namespace

std::size_t editDistance(std::string_view a, std::string_view b, std::size_t limit) {
  const std::size_t far = limit + 1;
  if (std::max(a.size(), b.size()) - std::min(a.size(), b.size()) > limit) return far;
  const std::string from = lowered(a), to = lowered(b);
  // Rows of the table of distances. Only cells within `limit` of its diagonal lie on a way that is short enough.
  std::vector<std::size_t> before(to.size() + 1, far), last(to.size() + 1), now(to.size() + 1);
  std::iota(last.begin(), last.end(), 0);
  for (std::size_t i = 1; i <= from.size(); ++i) {
    std::ranges::fill(now, far);
    now[0] = i;
    for (std::size_t j = i > limit ? i - limit : 1; j <= std::min(to.size(), i + limit); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1])
        now[j] = std::min(now[j], before[j - 2] + 1);
    }
    if (std::ranges::min(now) > limit && std::ranges::min(last) > limit) return far;
    before.swap(last);
    last.swap(now);
  }
  return std::min(last[to.size()], far);
}

std::string nearestName(std::string_view name, std::span<const std::string> candidates) {
  const std::optional<Nearest> found = findNearest(name, candidates);
  return found ? candidates[found->index] : std::string();
}

std::string nearestHint(std::string_view name, std::span<const std::string> candidates) {
  const std::optional<Nearest> nearest = findNearest(name, candidates);
  if (!nearest)
    return candidates.empty() || candidates.size() > 16
               ? ""
               : fmt::format("known: {}", fmt::join(candidates, ", "));
  // Others as near, at most two: "rgba16q" may be "rgba16" or "rgba16f".
  std::vector<std::string> all{candidates[nearest->index]};
  const std::size_t end = nearest->distance <= 2 ? std::min(candidates.size(), kMaxCandidates) : 0;
  for (std::size_t i = nearest->index + 1; all.size() < 3 && i < end; ++i)
    if (candidates[i] != all[0] && editDistance(name, candidates[i], nearest->distance) == nearest->distance)
      all.push_back(candidates[i]);
  return fmt::format("did you mean '{}'?", fmt::join(all, "' or '"));
}

}  // namespace weft::text
