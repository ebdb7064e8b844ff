#include "engine/assets/models/obj/polygon.h"

#include <numeric>

namespace weft::assets {

namespace {

double turnOf(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace

glm::dvec3 areaOf(std::span<const glm::dvec3> polygon) {
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < polygon.size(); ++i)
    sum += glm::cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  return sum;
}

// Ears are cut off, one after another: Meisters, "Polygons have ears", 1975.
std::vector<std::array<std::size_t, 3>> triangulate(std::span<const glm::dvec3> polygon, std::size_t& work) {
  // Seen along the axis that its normal is nearest to, counter-clockwise.
  const glm::dvec3 area = areaOf(polygon), size = glm::abs(area);
  const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  std::vector<glm::dvec2> at;
  for (const glm::dvec3& p : polygon) {
    const glm::dvec2 seen(p[(axis + 1) % 3], p[(axis + 2) % 3]);
    at.push_back(area[axis] < 0 ? glm::dvec2(seen.y, seen.x) : seen);
  }
  std::vector<std::size_t> left(polygon.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  const auto isEar = [&](std::size_t a, std::size_t b, std::size_t c) {
    if (turnOf(at[a], at[b], at[c]) <= 0) return false;
    for (const std::size_t other : left)
      if (at[other] != at[a] && at[other] != at[b] && at[other] != at[c] &&
          turnOf(at[a], at[b], at[other]) >= 0 && turnOf(at[b], at[c], at[other]) >= 0 &&
          turnOf(at[c], at[a], at[other]) >= 0)
        return false;
    return true;
  };
  std::vector<std::array<std::size_t, 3>> out;
  std::size_t next = 1, misses = 0;  // one after another, that are no ears
  while (left.size() > 3) {
    const std::size_t b = next % left.size(), a = (b + left.size() - 1) % left.size(),
                      c = (b + 1) % left.size();
    const bool looks = misses < left.size() && work >= left.size();
    if (looks) work -= left.size();
    if (looks && !isEar(left[a], left[b], left[c])) {
      ++next;
      ++misses;
      continue;
    }
    out.push_back({left[a], left[b], left[c]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(b));
    next = b;
    misses = 0;
  }
  if (left.size() == 3) out.push_back({left[0], left[1], left[2]});
  return out;
}

}  // namespace weft::assets
