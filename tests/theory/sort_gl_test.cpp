// The GPU sort against std::stable_sort by power, element for element.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "engine/scene/sort.h"
#include "tests/theory/lab.h"

namespace sort_test {

using namespace weft::theory;

namespace {

std::vector<std::uint32_t> sortedByTheory(const std::vector<Ball>& balls, glm::vec3 eye) {
  std::vector<float> power;
  for (const Ball& ball : balls) power.push_back(weft::scene::powerOf(eye, ball.center, ball.radius));
  std::vector<std::uint32_t> order(balls.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return power[a] > power[b]; });
  return order;
}

void compare(std::vector<Ball> balls) {
  Setup setup{.graph = "tests/theory/sort.json", .width = 4, .height = 4, .balls = balls};
  setup.camera = {.position = {3, 2, 20}, .target = {0.5, 0, 0}, .fovDegrees = 60, .nearPlane = 0.1};
  Lab lab(setup);
  lab.frame();
  const std::vector<std::uint32_t> words = lab.readBuffer("keys", balls.size() * 2);
  const std::vector<std::uint32_t> truth = sortedByTheory(balls, lab.view().eye);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < balls.size(); ++i) wrong += words[i * 2 + 1] != truth[i];
  CAPTURE(balls.size());
  CHECK(wrong == 0);
  CHECK(lab.reports() == "");
}

std::vector<Ball> randomBalls(std::size_t count, std::uint32_t seed, bool special) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-50, 50);
  std::vector<Ball> balls(count);
  for (Ball& ball : balls) {
    ball.center = {place(random), place(random), place(random)};
    if (!special) continue;
    const std::uint32_t kind = random() % 8;
    if (kind == 0) ball.center = balls[random() % count].center;  // equal keys
    if (kind == 1) ball.center = {1, 2, 3};
    if (kind == 2) ball.center.y = std::numeric_limits<float>::infinity();  // power becomes infinite
    if (kind == 3) ball.center.z = -std::numeric_limits<float>::infinity();
  }
  return balls;
}

}  // namespace

TEST_CASE("sort: any count, not only powers of two") {
  for (const std::size_t count :
       {1u, 2u, 3u, 5u, 17u, 100u, 511u, 1000u, 1023u, 1024u, 1025u, 2047u, 2048u, 2049u, 5000u})
    compare(randomBalls(count, static_cast<std::uint32_t>(count), false));
}

TEST_CASE("sort: equal keys and infinities keep their order") {
  for (const std::size_t count : {7u, 300u, 1500u, 4096u, 30000u})
    compare(randomBalls(count, static_cast<std::uint32_t>(count) + 1, true));
}

TEST_CASE("sort: 100,000 random instances") {
  compare(randomBalls(100000, 42, true));
}

TEST_CASE("sort: more than a million") {
  compare(randomBalls(1000001, 7, true));
}

TEST_CASE("sort: all equal") {
  compare(std::vector<Ball>(3000));
}

}  // namespace sort_test
