// Rough metals show other spheres as soft shapes: values and edges of reflections, pixel by pixel against paths.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/theory/neighbors/metals.h"
#include "tests/theory/statistics.h"

namespace neighbors_edges_test {

using namespace weft::theory;

namespace {

constexpr std::uint32_t kLowest = 22, kHighest = 64;  // rows where other spheres are reflected

// Three pixels of one rough metal: one, the next to the right, and the next above.
struct Corner {
  static constexpr int kAcross[3] = {0, 1, 0}, kUp[3] = {0, 0, 1};
  std::uint32_t x = 0, y = 0;
  std::array<glm::dvec3, 3> shown;  // of 255
};

glm::dvec3 shownColor(glm::dvec3 radiance) {
  for (int c = 0; c < 3; ++c) radiance[c] = shownOf255(std::max(radiance[c], 0.0));
  return radiance;
}

// All three pixels of a corner take the same random numbers, so that noise hardly makes edges.
std::vector<Corner> tracedCorners(const MetalScene& scene, std::uint32_t step, int side, unsigned seed) {
  const MetalTracer tracer(scene.setup);
  std::vector<Corner> corners;
  for (std::uint32_t y = kLowest; y < kHighest; y += step)
    for (std::uint32_t x = y / step % step; x + 1 < MetalScene::kWidth; x += step) {
      const int sphere = scene.sphereOf(tracer, x, y);
      if (sphere < 0 || sphere >= MetalScene::kRough || scene.sphereOf(tracer, x + 1, y) != sphere ||
          scene.sphereOf(tracer, x, y + 1) != sphere)
        continue;
      Corner corner{.x = x, .y = y, .shown = {}};
      ++seed;
      for (std::uint32_t i = 0; i < 3; ++i) {
        std::mt19937 random(seed);
        corner.shown[i] =
            shownColor(scene.truth(tracer, x + Corner::kAcross[i], y + Corner::kUp[i], side, random));
      }
      corners.push_back(corner);
    }
  return corners;
}

// How far values are off, and how far the differences to the next pixel are.
struct EdgesOff {
  std::vector<double> values, edges;
  double step = 0, truth = 0;  // the largest difference to the next pixel: found, and by paths
  void add(const std::array<glm::dvec3, 3>& is, const std::array<glm::dvec3, 3>& should) {
    for (int c = 0; c < 3; ++c) {
      values.push_back(std::abs(is[0][c] - should[0][c]));
      for (std::size_t i = 1; i < 3; ++i) {
        edges.push_back(std::abs((is[i][c] - is[0][c]) - (should[i][c] - should[0][c])));
        step = std::max(step, std::abs(is[i][c] - is[0][c]));
        truth = std::max(truth, std::abs(should[i][c] - should[0][c]));
      }
    }
  }
  void report(const std::string& what) {
    MESSAGE(what, ": values mean ", meanOf(values), ", 95th percentile ", percentileOf(values, 0.95),
            ", 99th ", percentileOf(values, 0.99), "; edges mean ", meanOf(edges), ", 95th percentile ",
            percentileOf(edges, 0.95), ", 99th ", percentileOf(edges, 0.99), ", most ",
            percentileOf(edges, 1), "; largest step ", step, ", by paths ", truth);
  }
};

}  // namespace

TEST_CASE("metals: reflections of lit and half-lit spheres that overlap have no edges that paths lack") {
  const MetalScene scene(MetalScene::Stand::amongLit);
  const std::vector<Corner> corners = tracedCorners(scene, 2, 48, 1);
  REQUIRE(corners.size() > 1000);
  Lab lab(scene.setup);
  lab.frame();
  const Picture picture = lab.read("hdr");
  CHECK(lab.reports() == "");
  EdgesOff off;
  for (const Corner& corner : corners) {
    std::array<glm::dvec3, 3> drawn;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const float* texel = picture.at(corner.x + Corner::kAcross[i], corner.y + Corner::kUp[i]);
      drawn[i] = shownColor({texel[0], texel[1], texel[2]});
    }
    off.add(drawn, corner.shown);
  }
  off.report("all");
  CHECK(meanOf(off.values) < 2.55);
  CHECK(percentileOf(off.values, 0.95) < 10.5);
  CHECK(percentileOf(off.values, 0.99) < 26.8);
  CHECK(percentileOf(off.edges, 0.95) < 4.52);
  CHECK(percentileOf(off.edges, 0.99) < 11);
  CHECK(percentileOf(off.edges, 1) < 33);
  CHECK(off.step < 1.65 * off.truth);  // measured: 46.6 of 29.4
}

TEST_CASE("metals: two sets of paths agree on lit spheres and on their edges") {
  const MetalScene scene(MetalScene::Stand::amongLit);
  const std::vector<Corner> one = tracedCorners(scene, 6, 48, 1),
                            other = tracedCorners(scene, 6, 48, 1000000);
  EdgesOff off;
  for (std::size_t i = 0; i < one.size(); ++i) off.add(one[i].shown, other[i].shown);
  off.report("two sets");
  CHECK(meanOf(off.values) < 1.2);
  CHECK(percentileOf(off.edges, 0.99) < 8);
}

TEST_CASE("metals: with a specular map of one level all light is a number") {
  MetalScene scene(MetalScene::Stand::onGround);
  scene.setup.graph = "tests/theory/neighbors/one_level.json";
  Lab lab(scene.setup);
  lab.frame();
  const Picture picture = lab.read("hdr");
  CHECK(lab.reports() == "");
  std::size_t bad = 0;
  for (const float value : picture.texels) bad += std::isfinite(value) && value >= 0 ? 0 : 1;
  CHECK(bad == 0);
}

TEST_CASE("ground: it gets some of the sky's light and no more than there is, whatever hides the sky") {
  Lab lab({.graph = "tests/theory/neighbors/extremes.json", .balls = {Ball{}}});
  lab.frame();
  const Picture picture = lab.read("on_ground");
  CHECK(lab.reports() == "");
  std::size_t bad = 0;  // a NaN is neither greater nor less
  for (std::uint32_t y = 0; y < 64; ++y)
    for (std::uint32_t x = 0; x < 64; ++x) {
      const float* is = picture.at(x, y);
      bad += is[0] >= 0 && is[0] <= 1.0001f && std::abs(is[1] - (x > 0 ? 0.0625f : 0)) < 1e-5f ? 0 : 1;
    }
  CHECK(bad == 0);
}

}  // namespace neighbors_edges_test
