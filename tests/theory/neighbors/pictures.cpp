// A tool, and no test (docs/figures.md): metals that reflect one another as Weft draws them, and by paths, as PNGs in the folder out.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/theory/neighbors/metals.h"

using namespace weft::theory;

namespace {

void draw(MetalScene::Stand stand, const std::string& name) {
  std::filesystem::create_directories("out");
  const MetalScene scene(stand);
  Lab lab(scene.setup);
  lab.frame();
  const Picture picture = lab.read("hdr");
  const MetalTracer tracer(scene.setup);
  std::mt19937 random(1);
  std::vector<std::uint8_t> drawn, truth;
  const auto add = [](std::vector<std::uint8_t>& bytes, glm::dvec3 color) {
    for (int c = 0; c < 3; ++c)
      bytes.push_back(static_cast<std::uint8_t>(std::lround(shownOf255(std::max(color[c], 0.0)))));
  };
  for (std::uint32_t y = MetalScene::kHeight; y-- > 0;)
    for (std::uint32_t x = 0; x < MetalScene::kWidth; ++x) {
      const float* texel = picture.at(x, y);
      add(drawn, {texel[0], texel[1], texel[2]});
      add(truth, scene.truth(tracer, x, y, 24, random));
    }
  weft::text::Diagnostics said;
  const int width = MetalScene::kWidth, height = MetalScene::kHeight;
  CHECK(weft::assets::savePng8("out/metals_" + name + "_drawn.png", width, height, 3, drawn, said));
  CHECK(weft::assets::savePng8("out/metals_" + name + "_reference.png", width, height, 3, truth, said));
}

}  // namespace

TEST_CASE("pictures of metals in the air") {
  draw(MetalScene::Stand::inTheAir, "air");
}

TEST_CASE("pictures of metals on a ground") {
  draw(MetalScene::Stand::onGround, "ground");
}

TEST_CASE("pictures of metals among lit spheres") {
  draw(MetalScene::Stand::amongLit, "lit");
}
