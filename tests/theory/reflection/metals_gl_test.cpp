// White metals of every roughness under a photographed sky with its sun, pixel by pixel against brute force.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "tests/theory/reflection/wall.h"
#include "tests/theory/statistics.h"

namespace reflection_metals_test {

using namespace weft::theory;

namespace {

using Wall = ReflectionWall;
constexpr const auto& kRoughness = Wall::kRoughness;
constexpr std::uint32_t kSide = Wall::kSide, kColumns = Wall::kColumns, kRows = Wall::kRows;

struct Difference {
  std::vector<double> values;
  double found = 0, truth = 0;  // sums of radiance
  void add(Vec3 a, Vec3 b) {
    for (const auto& [is, should] : {std::pair{a.x, b.x}, {a.y, b.y}, {a.z, b.z}}) {
      values.push_back(std::abs(shownOf255(is) - shownOf255(should)));
      found += is;
      truth += should;
    }
  }
};

// Calls visit(ball, x, y) for one pixel of each block of `step` x `step`, not always the same one.
template <typename Visit>
void forPixels(std::uint32_t step, const Visit& visit) {
  for (std::uint32_t y = 0; y + step <= kSide * kRows; y += step)
    for (std::uint32_t x = 0; x + step <= kSide * kColumns; x += step) {
      const std::uint32_t turn = (x / step) * 7 + (y / step) * 11;
      const std::uint32_t at = x + turn % step, up = y + turn / step % step;
      visit((kRows - 1 - up / kSide) * kColumns + at / kSide, at, up);
    }
}

weft::assets::ImageF skyOf(Lab& lab) {
  const Picture sky = lab.read("ibl.daylight.sky_map");
  return {static_cast<int>(sky.width), static_cast<int>(sky.height), 4, sky.texels};
}

void compare(double azimuth, bool daylight = false) {
  Wall wall(azimuth);
  wall.setup.daylight = daylight;
  Lab lab(wall.setup);
  lab.frame();
  const Picture picture = lab.read("panels");
  CHECK(lab.reports() == "");
  const ReflectionOracle oracle = daylight ? ReflectionOracle(skyOf(lab)) : bundledOracle();
  std::vector<ReflectionOracle::Metal> metals;
  for (const double roughness : kRoughness) metals.push_back(ReflectionOracle::metalOf(roughness));
  std::vector<Difference> differences(kRoughness.size());
  forPixels(6, [&](std::size_t ball, std::uint32_t x, std::uint32_t y) {
    Vec3 truth;
    if (!wall.truth(oracle, metals[ball], ball, x, y, 0, truth)) return;
    const float* texel = picture.at(x, y);
    differences[ball].add({texel[0], texel[1], texel[2]}, truth);
  });
  for (std::size_t i = 0; i < kRoughness.size(); ++i) {
    Difference& d = differences[i];
    REQUIRE(d.values.size() > 800);
    const double radiance = 100 * (d.found / d.truth - 1);
    CAPTURE(kRoughness[i]);
    MESSAGE("roughness ", kRoughness[i], ": mean ", meanOf(d.values), ", 95th percentile ",
            percentileOf(d.values, 0.95), ", radiance ", radiance, " %");
    CHECK(meanOf(d.values) < 2);
    CHECK(percentileOf(d.values, 0.95) < 8);
    if (!daylight && kRoughness[i] >= 0.2) CHECK(std::abs(radiance) < 2);
  }
}

}  // namespace

TEST_CASE(
    "reflection: two sets of samples of the brute-force integral agree far below what is asked of the "
    "picture") {
  const Wall wall(0);
  const ReflectionOracle oracle = bundledOracle();
  for (const std::size_t ball : {0u, 1u, 3u, 7u, 11u}) {
    const auto metal = ReflectionOracle::metalOf(kRoughness[ball]);
    Difference d;
    forPixels(16, [&](std::size_t at, std::uint32_t x, std::uint32_t y) {
      Vec3 one, other;
      if (at != ball || !wall.truth(oracle, metal, ball, x, y, 0, one)) return;
      wall.truth(oracle, metal, ball, x, y, 1u << 30, other);
      d.add(one, other);
    });
    REQUIRE(d.values.size() > 60);
    CAPTURE(kRoughness[ball]);
    MESSAGE("roughness ", kRoughness[ball], ": mean ", meanOf(d.values), ", 95th percentile ",
            percentileOf(d.values, 0.95));
    CHECK(meanOf(d.values) < 0.2);
    CHECK(percentileOf(d.values, 0.95) < 0.8);
  }
}

TEST_CASE(
    "reflection: white metals are what brute force says, mean 2 and 95th percentile 8 of 255, radiance "
    "within 2 %") {
  compare(0);
}

TEST_CASE("reflection: against the sun as well") {
  compare(215);
}

TEST_CASE("reflection: the computed sky, with its sun behind and before the eye") {
  for (const double azimuth : {-40.0, 140.0}) compare(azimuth, true);
}

}  // namespace reflection_metals_test
