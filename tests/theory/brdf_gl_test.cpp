// The BRDF table of graphs/ibl.json at texel centers, against independent integration.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/runtime/stage.h"
#include "tests/temporary_folder.h"
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

TEST_CASE("BRDF table: each size is whole, whether rows are interpolated or not") {
  for (const std::uint32_t size : {100u, 200u}) {
    CAPTURE(size);
    const TemporaryFolder folder;
    const std::string preset = folder.write(
        "size.json", R"({ "resources": { "ibl.brdf": { "size": )" + std::to_string(size) + " } } }");
    weft::runtime::test::Stage stage("tests/theory/furnace.json", 64, 64, "scenes/spheres.json", "",
                                     {preset});
    REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
    stage.run();
    const std::vector<float> texels = stage.read("ibl.brdf");
    REQUIRE(texels.size() == std::size_t{4} * size * size);
    for (std::uint32_t y = 0; y < size; ++y) {
      const std::uint32_t x = (37 * y + size / 2) % size;
      const Albedo truth = directionalAlbedo((x + 0.5) / size, (y + 0.5) / size, 360);
      const float* texel = &texels[(std::size_t{y} * size + x) * 4];
      CAPTURE(x);
      CAPTURE(y);
      CHECK(std::abs(texel[0] - truth.scale) < 0.0014);
      CHECK(std::abs(texel[1] - truth.bias) < 0.002);
    }
  }
}

}  // namespace brdf_test
