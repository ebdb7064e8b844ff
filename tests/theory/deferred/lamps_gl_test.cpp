// Clustered lamps against a loop over all of them: not a bit may differ, because lamps are added in the same order and those left out give
// exactly nothing.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/theory/lab.h"

namespace deferred_lamps_test {

using namespace weft::theory;

namespace {

constexpr std::uint32_t kWidth = 250, kHeight = 141;  // neither is a multiple of a tile

Setup manyLamps(int lamps, double reach, const weft::scene::CameraPose& camera) {
  Setup setup{.graph = "tests/theory/deferred/lamps.json"};
  setup.width = kWidth;
  setup.height = kHeight;
  setup.balls = {{.center = {0, 1, 0}, .albedo = {0.8f, 0.3f, 0.2f}, .metallic = 0, .roughness = 0.4f},
                 {.center = {3, 0.7f, 2}, .radius = 0.7f, .roughness = 0.3f},
                 {.center = {-4, 2, -3}, .radius = 2, .metallic = 0, .roughness = 0.8f}};
  setup.camera = camera;
  setup.sets = {{"lamps", std::to_string(lamps)}, {"reach", std::to_string(reach)}};
  return setup;
}

const weft::scene::CameraPose kAbove{
    .position = {0, 5, 14}, .target = {0, 0.5, 0}, .fovDegrees = 60, .nearPlane = 0.1};
const weft::scene::CameraPose kAmong{
    .position = {1, 0.8, 4}, .target = {-3, 1, -3}, .fovDegrees = 90, .nearPlane = 0.01};

Picture render(Setup setup, const char* set, const char* value) {
  setup.sets.push_back({set, value});
  Lab lab(setup);
  lab.frame();
  CHECK(lab.reports() == "");
  return lab.read("panels");
}

struct Sums {
  double light = 0;
  int surfaces = 0, different = 0;
};
Sums compare(const Picture& a, const Picture& b) {
  Sums sums;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      if (a.at(kWidth + x, y)[3] == 0) continue;
      ++sums.surfaces;
      for (int c = 0; c < 3; ++c) {
        sums.light += a.at(x, y)[c];
        sums.different += a.at(x, y)[c] != b.at(x, y)[c];
      }
    }
  return sums;
}

// Lamps that a pixel goes through, from the colors of SHOW_LAMPS; the mean over all surfaces.
double meanLookedAt(const Picture& heat) {
  double sum = 0;
  int surfaces = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const float* color = heat.at(x, y);
      if (heat.at(kWidth + x, y)[3] == 0) continue;
      ++surfaces;
      if (color[0] == color[2]) continue;  // none
      sum += std::exp2(3 * (color[2] > 0 ? 1 - color[2] : 1 + color[0]));
    }
  return sum / surfaces;
}

}  // namespace

TEST_CASE("clustered lamps: the loop over all of them, to the bit, for 0, 1, 100 and 1000 lamps") {
  for (const auto& camera : {kAbove, kAmong})
    for (const int lamps : {0, 1, 100, 1000}) {
      CAPTURE(lamps);
      const Setup setup = manyLamps(lamps, lamps == 1 ? 30 : 2, camera);
      const Sums sums = compare(render(setup, "clustered", "true"), render(setup, "clustered", "false"));
      CHECK(sums.surfaces > 15000);
      CHECK((sums.light > 1) == (lamps > 0));
      CHECK(sums.different == 0);
    }
}

TEST_CASE("clustered lamps: none is dropped where 1000 reach every pixel") {
  const Setup setup = manyLamps(1000, 200, kAbove);
  const Picture clustered = render(setup, "clustered", "true");
  const Sums sums = compare(clustered, render(setup, "clustered", "false"));
  CHECK(sums.surfaces > 15000);
  CHECK(sums.different == 0);
  CHECK(compare(clustered, render(setup, "clustered", "true")).different == 0);  // and again the same
}

TEST_CASE("clustered lamps: with tiles or slices disabled the picture is the same") {
  Setup setup = manyLamps(300, 2, kAbove);
  const Picture whole = render(setup, "clustered", "true");
  for (const char* pass : {"lamps_in_tiles", "lamps_in_slices"}) {
    setup.disables = {{pass}};
    CHECK(compare(whole, render(setup, "clustered", "true")).different == 0);
  }
}

TEST_CASE("clustered lamps: a pixel goes through few more than reach it") {
  const Setup setup = manyLamps(1000, 2, kAbove);
  const Picture heat = render(setup, "show_lamps", "true");
  const double looked_at = meanLookedAt(heat);
  MESSAGE("lamps looked at, mean: ", looked_at);
  CHECK(looked_at > 5);
  CHECK(looked_at < 60);
}

}  // namespace deferred_lamps_test
