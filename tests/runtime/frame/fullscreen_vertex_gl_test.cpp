// A fullscreen pass with a vertex shader of its own covers every pixel; the shader has the slots and parameters of the pass.
#include "tests/runtime/stage.h"

namespace frame_fullscreen_vertex_test {

using namespace weft;
using namespace weft::runtime::test;

TEST_CASE("what a vertex shader of a fullscreen pass computes arrives at every pixel") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/vertex.json", 8, 8);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run();
  const std::vector<float> texels = stage.read("ramp");
  for (std::size_t y = 0; y < 4; ++y)
    for (std::size_t x = 0; x < 8; ++x) {
      const float* texel = &texels[(y * 8 + x) * 4];
      CHECK(texel[0] == doctest::Approx((static_cast<double>(x) + 0.5) / 8));
      CHECK(texel[1] == doctest::Approx((static_cast<double>(y) + 0.5) / 4));
      CHECK(texel[2] == 7);
      CHECK(texel[3] == 1);
    }
}

}  // namespace frame_fullscreen_vertex_test
