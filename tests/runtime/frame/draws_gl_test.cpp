// Draws without meshes: vertices by number, a box, arguments from a buffer, no attachments, many layers.
#include <algorithm>
#include <array>

#include "tests/runtime/stage.h"

namespace frame_draws_test {

using namespace weft;
using namespace weft::runtime::test;

TEST_CASE("points, lines, strips, triangles and boxes cover the texels that OpenGL says, 14.4 to 14.6") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/draws.json", 16, 16);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run();
  std::array<std::array<float, 16>, 16> expected{};  // [y][x]
  const auto fill = [&](int x0, int y0, int x1, int y1, float value) {
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x)
        expected[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] = value;
  };
  fill(2, 2, 3, 3, 2);  // points of 1, 4 and 3 texels, around their centers
  fill(6, 6, 10, 10, 3);
  fill(3, 7, 6, 10, 4);
  fill(0, 5, 1, 6, 5);  // of the first record: vertices 3 and 4
  fill(2, 5, 3, 6, 6);
  fill(1, 12, 6, 13, 7);  // a line has not the texel in whose diamond it ends
  fill(1, 10, 6, 11, 7);
  fill(9, 12, 15, 13, 8);  // the strip has it as the first of its next line
  fill(14, 12, 15, 15, 8);
  fill(0, 14, 2, 16, 9);
  fill(11, 5, 15, 9, 3);  // the near face, once
  fill(11, 0, 15, 4, 1);  // the far face
  const std::vector<float> shown = stage.read("shown");
  for (std::size_t y = 0; y < 16; ++y)
    for (std::size_t x = 0; x < 16; ++x) {
      CAPTURE(x);
      CAPTURE(y);
      CHECK(shown[(16 * y + x) * 4] == expected[y][x]);
    }
}

TEST_CASE("a dispatch and a list say how much runs; a raster without attachments has a size and samples") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/draws.json", 16, 16);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run();
  const auto& graph = *stage.execution().plan().graph;
  const auto textureOf = [&](const char* name) {
    const auto found = std::ranges::find(graph.resourceNames, name);
    REQUIRE(found != graph.resourceNames.end());
    return stage.execution().texture(static_cast<std::uint32_t>(found - graph.resourceNames.begin()));
  };
  stage.execution().readBack().finish();
  const auto spheres = static_cast<double>(
      scene::Members(scene::DrawList::spheres, stage.world.scene()).count(stage.world.scene().spheres));
  CHECK(stage.renderer().output("tally") == std::vector<double>{0x33, 2 * spheres, 4});  // 3 by 2 work groups
  for (std::uint32_t z = 0; z < 4; ++z) {
    const std::vector<float> slice = gl::readFloats(textureOf("voxels"), 0, z);
    for (std::uint32_t i = 0; i < 64; ++i)
      CHECK(slice[std::size_t{i} * 4] == ((i % 8 + i / 8) % 4 == z ? static_cast<float>(1 + i) : 0.0F));
  }
  for (const auto& [name, layers] : {std::pair("layers", 3u), std::pair("cube", 6u)})
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
      const std::vector<float> texels = gl::readFloats(textureOf(name), 0, layer);
      for (std::size_t i = 0; i < texels.size(); i += 4) CHECK(texels[i] == static_cast<float>(layer + 1));
    }
}

}  // namespace frame_draws_test
