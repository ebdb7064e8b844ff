// A blit copies from the level and the layer that its references select, to those that they select.
#include <algorithm>

#include "tests/runtime/stage.h"

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
