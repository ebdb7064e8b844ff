// The BRDF table of graphs/ibl.json at texel centers, against independent integration.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/theory/lab.h"
#include "tests/theory/oracle.h"

namespace brdf_test {

using namespace weft::theory;

TEST_CASE("BRDF table: both channels within 0.005 of the integral at texel centers") {
  Lab lab({.graph = "tests/theory/furnace.json", .balls = {{}}});
  lab.frame();
  const Picture table = lab.read("ibl.brdf");
  REQUIRE(table.width == 512);
  REQUIRE(table.height == 512);
  double scale = 0, bias = 0, sum = 0;
  const std::uint32_t picks[] = {0, 1, 2, 4, 8, 16, 31, 64, 101, 150, 203, 256, 311, 370, 420, 475, 511};
  for (const std::uint32_t y : picks)
    for (const std::uint32_t x : picks) {
      const Albedo truth = directionalAlbedo((x + 0.5) / 512, (y + 0.5) / 512, 360);
      const float* texel = table.at(x, y);
      scale = std::max(scale, std::abs(texel[0] - truth.scale));
      bias = std::max(bias, std::abs(texel[1] - truth.bias));
      sum = std::max(sum, std::abs((texel[0] + texel[1]) / truth.sum() - 1));
    }
  MESSAGE("worst error: scale ", scale, ", bias ", bias, ", albedo relative ", sum);
  CHECK(scale < 0.0014);
  CHECK(bias < 0.002);
  CHECK(sum < 0.004);
  CHECK(lab.reports() == "");
}

}  // namespace brdf_test
