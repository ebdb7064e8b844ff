#include "engine/assets/images/compare.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace weft::assets;

TEST_CASE("equal pictures are equal, other shapes are not comparable") {
  const Image8 a{2, 2, 3, std::vector<std::uint8_t>(12, 7)};
  CHECK(compareImages(a, a).equal());
  CHECK(std::isinf(compareImages(a, a).psnr));
  const Image8 b{3, 2, 3, std::vector<std::uint8_t>(18, 7)};
  CHECK_FALSE(compareImages(a, b).sameShape);
  CHECK_FALSE(compareImages(a, b).equal());
}

TEST_CASE("one changed component is found, measured and located") {
  const Image8 a{4, 2, 3, std::vector<std::uint8_t>(24, 100)};
  Image8 b = a;
  b.texels[(1 * 4 + 2) * 3 + 1] = 110;
  b.texels[0] = 101;
  const Comparison c = compareImages(a, b);
  CHECK(c.maxDifference == 10);
  CHECK(c.meanDifference == doctest::Approx(11.0 / 24));
  CHECK(c.differingPixels == 2);
  CHECK(compareImages(a, b, 1).differingPixels == 1);
  CHECK(c.worstX == 2);
  CHECK(c.worstY == 1);
  CHECK(c.psnr == doctest::Approx(10 * std::log10(255.0 * 255.0 * 24 / 101)));
}

TEST_CASE("NaN equals NaN and nothing else; infinities equal themselves") {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  const ImageF a{3, 1, 1, {nan, infinity, 1}};
  CHECK(compareImages(a, a).equal());
  ImageF b = a;
  b.texels[0] = 0;
  CHECK(std::isinf(compareImages(a, b).maxDifference));
  CHECK(compareImages(a, b).differingPixels == 1);
}

TEST_CASE("the difference picture is amplified, saturated and opaque") {
  const Image8 a{2, 1, 4, {10, 20, 30, 255, 0, 0, 0, 255}};
  const Image8 b{2, 1, 4, {11, 20, 200, 255, 0, 0, 0, 0}};
  CHECK(makeDifference(a, b, 16).texels == std::vector<std::uint8_t>{16, 0, 255, 255, 0, 0, 0, 255});
}
