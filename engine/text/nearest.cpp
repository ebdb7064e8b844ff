#include "engine/text/nearest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <optional>

#include "engine/text/chars.h"

namespace weft::text {

namespace {

// Cells of distance tables and candidates looked at, per run.
constexpr std::uint64_t kBudget = 400'000'000;
constexpr std::uint64_t kPerCandidate = 4;

std::atomic<std::uint64_t> spent{0};
std::atomic<std::size_t> uncompared{0};

// The distance of names in lower case. Only the cells within `limit` of the diagonal can lie on a way that is short
// enough.
std::size_t bandedDistance(std::string_view a, std::string_view b, std::size_t limit) {
  if (a.size() > b.size()) std::swap(a, b);
  const std::size_t far = limit + 1;
  if (b.size() - a.size() > limit) return far;
  const std::size_t width = b.size() + 1;
  thread_local std::vector<std::size_t> before, last, now;
  before.assign(width + 1, far);
  last.assign(width + 1, far);
  now.assign(width + 1, far);
  for (std::size_t j = 0; j < width && j <= limit; ++j) last[j] = j;
  std::size_t cells = 0, distance = far;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    const std::size_t from = i > limit ? i - limit : 0, to = std::min(b.size(), i + limit);
    std::size_t least = far;
    if (from > 0) now[from - 1] = far;
    for (std::size_t j = from; j <= to; ++j) {
      if (j == 0) {
        now[0] = i;
      } else {
        const bool same = a[i - 1] == b[j - 1];
        now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
        if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
          now[j] = std::min(now[j], before[j - 2] + 1);
      }
      least = std::min(least, now[j]);
    }
    now[to + 1] = far;
    cells += to - from + 1;
    // A swap reaches back over a row: both must be too far.
    if (least > limit) {
      const std::size_t earlier =
          *std::min_element(last.begin() + static_cast<std::ptrdiff_t>(from > 0 ? from - 1 : 0),
                            last.begin() + static_cast<std::ptrdiff_t>(to + 1));
      if (earlier >= limit) break;
    }
    if (i == a.size()) distance = std::min(now[b.size()], far);
    before.swap(last);
    last.swap(now);
  }
  spent.fetch_add(cells, std::memory_order_relaxed);
  return a.empty() ? b.size() : distance;
}

// Two edits make another word of a short one, unless it begins the same: "mul" is not "all", "round" not "count".
bool isFar(std::string_view name, std::string_view candidate, std::size_t distance) {
  return distance > 1 && name.size() < 6 && name[0] != candidate[0];
}

struct Nearest {
  std::size_t index = 0, distance = 0;
};

// The first of the nearest candidates, when it is near enough.
std::optional<Nearest> findNearest(std::string_view name, std::span<const std::string> candidates) {
  if (name.size() > kLongestName || candidates.empty()) return std::nullopt;
  const std::size_t allowed = std::max<std::size_t>(2, name.size() / 3);
  if (name.empty()) return std::nullopt;
  std::size_t limit = std::min(allowed, name.size() - 1);
  const std::string wanted = lowered(name);
  std::optional<Nearest> found;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const std::string& candidate = candidates[i];
    if (spent.fetch_add(kPerCandidate, std::memory_order_relaxed) >= kBudget) {
      uncompared.fetch_add(1, std::memory_order_relaxed);
      return std::nullopt;
    }
    const std::size_t shorter = std::min(candidate.size(), wanted.size());
    if (candidate.size() + wanted.size() - 2 * shorter > limit) continue;
    const std::string other = lowered(candidate);
    const std::size_t distance = bandedDistance(wanted, other, limit);
    if (distance > limit || isFar(wanted, other, distance)) continue;
    found = {i, distance};
    if (distance == 0) break;
    limit = distance - 1;
  }
  return found;
}

}  // namespace

std::size_t editDistance(std::string_view a, std::string_view b) {
  return editDistance(a, b, std::max(a.size(), b.size()));
}

std::size_t editDistance(std::string_view a, std::string_view b, std::size_t limit) {
  return bandedDistance(lowered(a), lowered(b), limit);
}

std::string nearestName(std::string_view name, std::span<const std::string> candidates) {
  const std::optional<Nearest> found = findNearest(name, candidates);
  return found ? candidates[found->index] : std::string();
}

std::string nearestHint(std::string_view name, std::span<const std::string> candidates) {
  if (const std::optional<Nearest> nearest = findNearest(name, candidates)) {
    // Others as near, at most two: "rgba16q" may be "rgba16" or "rgba16f".
    const std::string& first = candidates[nearest->index];
    std::string all = fmt::format("'{}'", first);
    int more = 0;
    for (std::size_t i = nearest->index + 1; nearest->distance <= 2 && more < 2 && i < candidates.size(); ++i)
      if (candidates[i] != first &&
          editDistance(name, candidates[i], nearest->distance) == nearest->distance) {
        all += fmt::format(" or '{}'", candidates[i]);
        ++more;
      }
    return fmt::format("did you mean {}?", all);
  }
  if (!candidates.empty() && candidates.size() <= 12)
    return fmt::format("known: {}", fmt::join(candidates, ", "));
  return {};
}

std::size_t takeUncompared() {
  spent = 0;
  return uncompared.exchange(0);
}

}  // namespace weft::text
