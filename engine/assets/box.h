// Axis-aligned boxes.
#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace weft::assets {

struct Box {
  glm::vec3 low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};

  bool empty() const { return !(low.x <= high.x && low.y <= high.y && low.z <= high.z); }
  glm::vec3 center() const { return (low + high) * 0.5f; }
  void add(glm::vec3 point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  void add(const Box& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  friend bool operator==(const Box&, const Box&) = default;
};

// The box of what is in `box`, moved by an affine `transform`; the empty box stays empty. Arvo, "Transforming Axis-Aligned
// Bounding Boxes", Graphics Gems, 1990.
inline Box transformBox(const glm::mat4& transform, const Box& box) {
  if (box.empty()) return {};
  Box out{glm::vec3(transform[3]), glm::vec3(transform[3])};
  for (int column = 0; column < 3; ++column) {
    const glm::vec3 a = glm::vec3(transform[column]) * box.low[column];
    const glm::vec3 b = glm::vec3(transform[column]) * box.high[column];
    out.low += glm::min(a, b);
    out.high += glm::max(a, b);
  }
  return out;
}

}  // namespace weft::assets
