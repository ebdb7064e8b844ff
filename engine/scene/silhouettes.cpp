#include "engine/scene/silhouettes.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace weft::scene {

namespace {

// The axis along which the directions are spread most: the fewest spans overlap there.
template <typename Items>
int widestAxis(const Items& items) {
  glm::vec3 sum(0), squares(0);
  for (const auto& item : items) {
    sum += item.towards;
    squares += item.towards * item.towards;
  }
  const glm::vec3 spread = squares - sum * sum / float(std::max<std::size_t>(items.size(), 1));
  return spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
}

}  // namespace

void Silhouettes::find(std::span<const Instance> instances, glm::vec3 eye, float near) {
  seen_.clear();
  pairs_.clear();
  if (instances.size() <= kMaxSpheres) {
    for (std::size_t i = 0; i < instances.size(); ++i) {
      const Instance& instance = instances[i];
      const glm::vec3 to = instance.center - eye;
      const float distance = glm::length(to), power = powerOf(eye, instance.center, instance.radius);
      // From within there is no silhouette; nor has what is not a number, or infinitely far.
      if (!(instance.radius > 0 && power > 0 && std::isfinite(power))) continue;
      seen_.push_back({.towards = to / distance,
                       .angle = std::asin(std::min(instance.radius / distance, 1.0f)),
                       .drawn = {depthKey(power), static_cast<std::uint32_t>(i)}});
    }
    findPairs(near);
  }
  // The spheres of each in the order in which they are drawn.
  std::sort(pairs_.begin(), pairs_.end(), [&](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : seen_[a.second].drawn < seen_[b.second].drawn;
  });
  rows_.assign(std::max<std::size_t>(instances.size(), 1), glm::uvec4(0));
  for (std::size_t begin = 0, end = 0; begin < pairs_.size(); begin = end) {
    while (end < pairs_.size() && pairs_[end].first == pairs_[begin].first) ++end;
    const std::size_t count = std::min(end - begin, kMaxEach);
    rows_[seen_[pairs_[begin].first].drawn.index] = {rows_.size(), count, 0, 0};
    for (std::size_t pair = end - count; pair < end; ++pair) {
      const Instance& before = instances[seen_[pairs_[pair].second].drawn.index];
      const glm::vec3 to = before.center - eye;
      rows_.emplace_back(std::bit_cast<std::uint32_t>(to.x), std::bit_cast<std::uint32_t>(to.y),
                         std::bit_cast<std::uint32_t>(to.z), std::bit_cast<std::uint32_t>(before.radius));
    }
  }
}

// By sweep: only spheres whose spans along one axis overlap are compared.
void Silhouettes::findPairs(float near) {
  const int axis = widestAxis(seen_);
  for (Seen& sphere : seen_) {
    // A point at an angle from a direction is at most as far from it along an axis.
    sphere.low = sphere.towards[axis] - sphere.angle - near;
    sphere.high = sphere.towards[axis] + sphere.angle;
  }
  std::sort(seen_.begin(), seen_.end(), [](const Seen& a, const Seen& b) {
    return a.low != b.low ? a.low < b.low : a.drawn.index < b.drawn.index;
  });
  for (std::uint32_t i = 0; i < seen_.size(); ++i)
    for (std::uint32_t k = i + 1; k < seen_.size() && seen_[k].low <= seen_[i].high; ++k) {
      const Seen &a = seen_[i], &b = seen_[k];
      const float square = glm::dot(a.towards - b.towards, a.towards - b.towards),
                  reach = a.angle + b.angle + near;
      if (square > reach * reach) continue;  // a chord is shorter than its arc
      const float apart = 2 * std::asin(std::min(0.5f * std::sqrt(square), 1.0f));
      if (apart > reach || apart < std::abs(a.angle - b.angle) - near) continue;
      const bool first = a.drawn < b.drawn;
      pairs_.emplace_back(first ? i : k, first ? k : i);
      if (pairs_.size() > kMaxPairs) return pairs_.clear();
    }
}

}  // namespace weft::scene
