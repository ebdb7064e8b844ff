// Which silhouettes of spheres meet in the picture. A sphere that covers a pixel in part must know the edges of those before it in that
// pixel, because alpha says how much is covered and not where. Spheres only; which of two is before the other, powerOf() says (sort.h).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/scene/sort.h"

namespace weft::scene {

class Silhouettes {
 public:
  // Of more spheres none are found, and a sphere knows at most so many before it, those that are drawn last.
  static constexpr std::size_t kMaxSpheres = 4096, kMaxEach = 32;
  static constexpr std::size_t kMaxPairs = 131072;  // that meet; of more none are found either

  // `near`: radians; silhouettes that come so near to each other, seen from `eye`, meet. Costs n log n in the spheres and in the pairs
  // that meet, and looks at each pair whose spans along one axis overlap. Allocates nothing when called again with as many.
  void find(std::span<const Instance> instances, glm::vec3 eye, float near);

  // Elements 0 to instances - 1: first element and number of the spheres before it, and two zeros. Then, for each such sphere, the bits of four
  // floats: its center from the eye, world axes, and its radius. At least one element.
  const std::vector<glm::uvec4>& rows() const { return rows_; }

 private:
  struct Seen {
    glm::vec3 towards{0};  // unit
    float angle = 0;       // between it and the silhouette
    SortElement drawn;     // lesser: drawn before
    float low = 0, high = 0;
  };
  void findPairs(float near);

  std::vector<Seen> seen_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>>
      pairs_;  // the one behind, that before it: indices into seen_
  std::vector<glm::uvec4> rows_;
};

}  // namespace weft::scene
