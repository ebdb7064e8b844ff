// A blit copies from the level and the layer that its references select, to those that they select.
#include <algorithm>

#include "tests/runtime/stage.h"

namespace frame_blit_test {

using namespace weft;
using namespace weft::runtime::test;

TEST_CASE("a blit takes and gives the level and the layer that it says") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/blit.json", 8, 8, "scenes/empty.json");
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run();
  const auto& names = stage.execution().plan().graph->resourceNames;
  const auto found = std::ranges::find(names, "to");
  REQUIRE(found != names.end());
  const gl::TextureRef to = stage.execution().texture(static_cast<std::uint32_t>(found - names.begin()));
  for (std::uint32_t mip = 0; mip < 2; ++mip)
    for (std::uint32_t layer = 0; layer < 2; ++layer) {
      const std::vector<float> texels = gl::readFloats(to, mip, layer);
      for (std::size_t i = 0; i < texels.size(); i += 4)
        CHECK(texels[i] == static_cast<float>(1 + mip + 2 * (1 - layer)));
    }
}

TEST_CASE(
    "what a pass needs and no other reads: a counter, the raster of a draw that only stores; and copies of "
    "buffers") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/kept.json", 16, 16, "scenes/empty.json");
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run();
  const std::vector<float> shown = stage.read("result");
  const auto at = [&](int x, int y) { return shown.data() + 4 * (16 * y + x); };
  for (std::size_t i = 0; i < shown.size(); i += 4)
    CHECK(shown[i] == 3);     // nothing was drawn over the picture
  CHECK(at(0, 0)[1] == 1);    // in the triangle
  CHECK(at(7, 7)[1] == 0);    // in the raster, outside the triangle
  CHECK(at(12, 1)[1] == 0);   // outside the raster of 8 by 8
  CHECK(at(0, 0)[2] == 7);    // each thread had a place of its own
  CHECK(at(15, 15)[3] == 7);  // and all of it was copied
}

}  // namespace frame_blit_test
