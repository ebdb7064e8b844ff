// Which silhouettes meet, against a walk around each of them.
#include "engine/scene/silhouettes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "engine/scene/sort.h"

using namespace weft::scene;

namespace {

std::vector<Instance> anyInstances(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-4, 4), size(0.05f, 0.8f);
  std::vector<Instance> instances(count);
  for (Instance& one : instances) {
    one.center = {place(random), place(random), place(random) - 8};
    one.radius = size(random);
  }
  return instances;
}

// The spheres that one has before it, as the rows say it: their places in the table.
std::multiset<std::size_t> foundOf(const Silhouettes& found, const std::vector<Instance>& instances,
                                   std::size_t i, glm::vec3 eye) {
  std::multiset<std::size_t> result;
  const glm::uvec4 head = found.rows()[i];
  for (std::uint32_t k = 0; k < head.y; ++k) {
    const glm::uvec4 row = found.rows().at(head.x + k);
    const glm::vec3 to = {std::bit_cast<float>(row.x), std::bit_cast<float>(row.y),
                          std::bit_cast<float>(row.z)};
    const auto is = std::ranges::find_if(instances, [&](const Instance& one) {
      return one.center - eye == to && one.radius == std::bit_cast<float>(row.w);
    });
    REQUIRE(is != instances.end());
    result.insert(std::size_t(is - instances.begin()));
  }
  return result;
}

// The least angle between the silhouettes of two spheres, by 2,000 points of the one: directions that touch it.
double apart(const Instance& a, const Instance& b, glm::dvec3 eye) {
  const glm::dvec3 toA = glm::dvec3(a.center) - eye, toB = glm::dvec3(b.center) - eye;
  const double angleA = std::asin(double(a.radius) / glm::length(toA)),
               angleB = std::asin(double(b.radius) / glm::length(toB));
  const glm::dvec3 axis = glm::normalize(toA), b_axis = glm::normalize(toB);
  const glm::dvec3 x =
      glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
  const glm::dvec3 y = glm::cross(axis, x);
  double least = 10;
  for (int i = 0; i < 2000; ++i) {
    const double turn = i * 2 * 3.14159265358979 / 2000;
    const glm::dvec3 point =
        std::cos(angleA) * axis + std::sin(angleA) * (std::cos(turn) * x + std::sin(turn) * y);
    least = std::min(least, std::abs(std::acos(std::clamp(glm::dot(point, b_axis), -1.0, 1.0)) - angleB));
  }
  return least;
}

}  // namespace

TEST_CASE(
    "silhouettes: each sphere knows those before it whose silhouettes come near its own, and no others") {
  const std::vector<Instance> instances = anyInstances(60, 5);
  const glm::vec3 eye{0.5f, -0.2f, 3};
  constexpr float kNear = 0.01f;
  Silhouettes found;
  found.find(instances, eye, kNear);
  std::size_t met = 0;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const std::multiset<std::size_t> before = foundOf(found, instances, i, eye);
    for (std::size_t k = 0; k < instances.size(); ++k) {
      if (k == i) continue;
      const bool nearer = powerOf(eye, instances[k].center, instances[k].radius) <
                          powerOf(eye, instances[i].center, instances[i].radius);
      const double angle = apart(instances[i], instances[k], eye);
      if (std::abs(angle - double(kNear)) < 1e-4) continue;  // the walk is not finer
      CHECK(before.count(k) == (nearer && angle < double(kNear)));
      met += nearer && angle < double(kNear);
    }
  }
  CHECK(met > 60);
}

TEST_CASE("silhouettes: nothing of spheres around the eye, without a size, or that are no numbers") {
  std::vector<Instance> instances(6);
  instances[0] = {.center = {0, 0, -5}, .radius = 1};
  instances[1] = {.center = {1, 0, -4}, .radius = 1};
  instances[2] = {.center = {0, 0, 0}, .radius = 2};  // around the eye
  instances[3] = {.center = {0.5f, 0, -4}, .radius = 0};
  instances[4] = {.center = {std::numeric_limits<float>::quiet_NaN(), 0, 0}, .radius = 1};
  instances[5] = {.center = {0, 0, -std::numeric_limits<float>::infinity()}, .radius = 1};
  Silhouettes found;
  found.find(instances, glm::vec3(0), 0.01f);
  CHECK(found.rows()[0].y == 1);
  for (std::size_t i = 1; i < 6; ++i) CHECK(found.rows()[i].y == 0);
  found.find({}, glm::vec3(0), 0.01f);
  CHECK(found.rows().size() == 1);
}

TEST_CASE("silhouettes: of a crowd those that are drawn last, and none of too many spheres") {
  std::vector<Instance> instances;
  for (int i = 0; i < 50; ++i)
    instances.push_back({.center = {0, 0, -100.0f + float(i)}, .radius = (100.0f - float(i)) / 50});
  Silhouettes found;
  found.find(instances, glm::vec3(0), 0.01f);
  const glm::uvec4 head = found.rows()[0];
  REQUIRE(head.y == Silhouettes::kMaxEach);
  CHECK(std::bit_cast<float>(found.rows()[head.x + head.y - 1].z) == -51.0f);  // the nearest of all
  found.find(anyInstances(Silhouettes::kMaxSpheres + 1, 1), glm::vec3(0), 0.01f);
  CHECK(found.rows().size() == Silhouettes::kMaxSpheres + 1);
  CHECK(std::ranges::all_of(found.rows(), [](glm::uvec4 row) { return row.y == 0; }));
}

TEST_CASE("silhouettes: where nearly all meet, none are found, rather than millions of pairs") {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> place(-1, 1);
  std::vector<Instance> instances(2000);
  for (Instance& one : instances)
    one = {.center = {place(random), place(random), place(random) - 8}, .radius = 0.5f};
  Silhouettes found;
  found.find(instances, glm::vec3(0), 0.01f);
  CHECK(found.rows().size() == instances.size());
  CHECK(std::ranges::all_of(found.rows(), [](glm::uvec4 row) { return row.y == 0; }));
}
