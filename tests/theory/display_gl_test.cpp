// From radiance to encoded values: exposure, curve, sRGB and dither on constant pictures; bloom that is mixed keeps them; an
// empty scene; anti-aliasing that leaves flat pictures alone.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "tests/theory/lab.h"

namespace display_test {

using namespace weft::theory;

namespace {

double encode(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

// Hable's curve as published (A B C D E F = .15 .5 .1 .2 .02 .3), gain 3, white 8.
double filmic(double x) {
  const auto f = [](double v) {
    return (v * (0.15 * v + 0.1 * 0.5) + 0.2 * 0.02) / (v * (0.15 * v + 0.5) + 0.2 * 0.3) - 0.02 / 0.3;
  };
  return f(3 * x) / f(3 * 8.0);
}

struct Levels {
  double mean = 0, low = 1e9, high = -1e9;
};

// The presented picture of an empty scene under a constant sky, in 8-bit steps.
Levels levelsOf(float radiance, std::vector<weft::graph::Setting> sets, const char* picture = "post.ldr") {
  Setup setup{.graph = "graphs/studio.json", .width = 64, .height = 48, .sets = std::move(sets)};
  setup.sets.emplace_back("curve", "filmic");
  setup.environment = constantEnvironment(radiance, radiance, radiance);
  Lab lab(setup);
  lab.frame();
  const Picture result = lab.read(picture);
  Levels levels;
  for (std::uint32_t y = 0; y < result.height; ++y)
    for (std::uint32_t x = 0; x < result.width; ++x) {
      const double value = 255.0 * result.at(x, y)[1];
      levels.mean += value / (result.width * result.height);
      levels.low = std::min(levels.low, value);
      levels.high = std::max(levels.high, value);
    }
  CHECK(lab.reports() == "");
  return levels;
}

}  // namespace

TEST_CASE(
    "display: the filmic curve and sRGB, in the mean within a tenth of a step, no pixel off by more than "
    "one") {
  for (const float radiance : {0.02f, 0.18f, 1.0f, 4.0f}) {
    const Levels levels = levelsOf(radiance, {{"bloom", "false"}});
    const double truth = 255 * encode(filmic(radiance));
    CAPTURE(radiance);
    CHECK(std::abs(levels.mean - truth) < 0.028);
    CHECK(levels.low >= std::floor(truth) - 0.01);
    CHECK(levels.high <= std::ceil(truth) + 0.01);
  }
}

TEST_CASE("display: exposure counts stops") {
  const Levels one = levelsOf(0.5f, {{"bloom", "false"}, {"exposure", "-1"}});
  CHECK(std::abs(one.mean - 255 * encode(filmic(0.25))) < 0.027);
}

TEST_CASE("display: black stays black and far beyond white is white") {
  CHECK(levelsOf(0.0f, {{"bloom", "false"}}).high == 0);
  CHECK(levelsOf(500.0f, {{"bloom", "false"}}).low == doctest::Approx(255));
}

TEST_CASE("bloom at threshold 0 keeps a constant picture") {
  // r11f_g11f_b10f has six bits of mantissa: half a step of it in a share of 5 %.
  const Levels levels = levelsOf(0.5f, {{"bloom", "true"}, {"threshold", "0"}, {"knee", "0"}});
  CHECK(std::abs(levels.mean - 255 * encode(filmic(0.5))) < 0.033);
}

TEST_CASE("anti-aliasing leaves a flat picture as it is, and can be switched off") {
  const Levels with = levelsOf(0.3f, {{"bloom", "false"}});
  const Levels without = levelsOf(0.3f, {{"bloom", "false"}, {"fxaa", "false"}}, "post.ldr");
  CHECK(with.mean == without.mean);
}

}  // namespace display_test
