#include "engine/scene/sort.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace weft::scene;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::vector<SortElement> keysOf(const std::vector<float>& depths) {
  std::vector<SortElement> elements;
  for (std::size_t i = 0; i < depths.size(); ++i)
    elements.push_back({depthKey(depths[i]), static_cast<std::uint32_t>(i)});
  return elements;
}

// The order by the meaning of depth alone: farthest first, NaN last, equal depths by index.
std::vector<std::uint32_t> orderByMeaning(const std::vector<float>& depths) {
  std::vector<std::uint32_t> order(depths.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (std::isnan(depths[a]) || std::isnan(depths[b]))
      return !std::isnan(depths[a]) && std::isnan(depths[b]);
    return depths[a] > depths[b];
  });
  return order;
}

void checkSort(const std::vector<float>& depths) {
  std::vector<SortElement> sorted = keysOf(depths), scratch;
  sortElements(sorted, scratch);
  REQUIRE(std::is_sorted(sorted.begin(), sorted.end()));
  const std::vector<std::uint32_t> expected = orderByMeaning(depths);
  for (std::size_t i = 0; i < expected.size(); ++i) REQUIRE(sorted[i].index == expected[i]);
}

}  // namespace

TEST_CASE("keys ascend as depth descends; zeros are one; NaN is last; padding follows everything") {
  const std::vector<float> descending = {kInfinity, 3e38f, 2, 1, 1e-40f, 0, -1e-40f, -1, -3e38f, -kInfinity};
  for (std::size_t i = 1; i < descending.size(); ++i)
    CHECK(depthKey(descending[i - 1]) < depthKey(descending[i]));
  CHECK(depthKey(0.0f) == depthKey(-0.0f));
  CHECK(depthKey(kNan) == 0xffffffffu);
  CHECK(depthKey(-kNan) == 0xffffffffu);
  CHECK(depthKey(-kInfinity) < 0xffffffffu);
  CHECK(depthKey(1.0f) == 0x407fffffu);   // the documented mapping, by hand: ~(0x3f800000 | 0x80000000)
  CHECK(depthKey(-1.0f) == 0xbf800000u);  // ~(~0xbf800000)
}

TEST_CASE("the order is that of the depths, for every count to 2000") {
  std::mt19937 random(1);
  std::vector<float> depths;
  for (std::size_t n = 0; n <= 2000; ++n) {
    depths.resize(n);
    const bool few = n % 3 == 0;  // many equal keys
    for (float& d : depths)
      d = few ? static_cast<float>(random() % 7) - 3
              : std::uniform_real_distribution<float>(-100, 100)(random);
    for (std::size_t special = 0; special < n / 8; ++special) {
      constexpr float kSpecials[] = {kInfinity, -kInfinity, 0.0f, -0.0f, kNan, -kNan};
      depths[random() % n] = kSpecials[random() % 6];
    }
    checkSort(depths);
  }
}

TEST_CASE("a hundred thousand, of any bits, all equal, sorted and reversed") {
  std::mt19937 random(2);
  std::vector<float> depths(100000);
  for (float& d : depths) d = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
  checkSort(depths);
  std::fill(depths.begin(), depths.end(), 4.0f);
  checkSort(depths);
  for (std::size_t i = 0; i < depths.size(); ++i) depths[i] = static_cast<float>(i);
  checkSort(depths);
  std::reverse(depths.begin(), depths.end());
  checkSort(depths);
}

TEST_CASE("the draw order of instances is back to front, and that of the table where they are as far") {
  std::vector<Instance> instances(4);
  instances[0].center = {0, 0, 1};
  instances[1].center = {9, 9, -5};
  instances[2].center = {0, 0, 1};
  instances[3].center = {0, 0, 7};
  std::vector<SortElement> order, scratch;
  drawOrder(instances, {0, 0, 20}, order, scratch);
  REQUIRE(order.size() == 4);
  CHECK(order[0].index == 1);
  CHECK(order[1].index == 0);
  CHECK(order[2].index == 2);
  CHECK(order[3].index == 3);
  drawOrder({}, {0, 0, 20}, order, scratch);
  CHECK(order.empty());
}

// The judge shoots rays: of two spheres that do not meet, the one that a ray meets first is before the other.
TEST_CASE("no sphere that hides another comes before it") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 1), size(0.05, 0.9);
  std::size_t wrong = 0, pairs = 0;
  while (pairs < 2000) {
    std::vector<Instance> both(2);
    for (Instance& one : both) {
      one.center = glm::vec3(3 * place(random), 3 * place(random), -3 + 2 * place(random));
      one.radius = float(size(random));
    }
    const glm::dvec3 a(both[0].center), b(both[1].center);
    const double ra = double(both[0].radius), rb = double(both[1].radius);
    if (glm::length(a - b) < ra + rb || glm::length(a) < ra || glm::length(b) < rb) continue;
    const double between = std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0, 1.0));
    const bool apart = between > std::asin(ra / glm::length(a)) + std::asin(rb / glm::length(b));
    if (apart) continue;  // no ray meets both

    int first = -1;  // that hides the other
    for (int i = 0; i < 4000 && first < 0; ++i) {
      const glm::dvec3 towards =
          glm::normalize(a + ra * glm::dvec3(place(random), place(random), place(random)));
      const auto hit = [&](glm::dvec3 c, double r) {
        const double along = glm::dot(c, towards), square = along * along - glm::dot(c, c) + r * r;
        return square > 0 && along > 0 ? along - std::sqrt(square) : std::numeric_limits<double>::infinity();
      };
      const double toA = hit(a, ra), toB = hit(b, rb);
      if (std::isfinite(toA) && std::isfinite(toB)) first = toA < toB ? 0 : 1;
    }
    if (first < 0) continue;
    ++pairs;
    std::vector<SortElement> order, scratch;
    drawOrder(both, glm::vec3(0), order, scratch);
    wrong += order.back().index != std::uint32_t(first);
  }
  CHECK(wrong == 0);
}
