#include <doctest/doctest.h>

#include "engine/assets/images/flip.h"

using namespace weft::assets;

TEST_CASE("equal pictures are equal, other shapes are not comparable") {
  const Image8 a{2, 2, 3, std::vector<std::uint8_t>(12, 7)};
  CHECK(compareImages(a, a).equal());
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
  CHECK(c.differingPixels == 2);
  CHECK(compareImages(a, b, 1).differingPixels == 1);
  CHECK(c.worstX == 2);
  CHECK(c.worstY == 1);
}
