// A tool, and no test (docs/figures.md): what Weft draws, and what brute force says, as PNGs in the folder out.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <vector>

#include "tests/theory/reflection/wall.h"

using namespace weft::theory;

TEST_CASE("pictures of reflections") {
  const ReflectionWall wall(0);
  Lab lab(wall.setup);
  lab.frame();
  const Picture picture = lab.read("panels");
  const ReflectionOracle oracle = bundledOracle();
  std::vector<std::uint8_t> drawn, truth;
  const auto add = [](std::vector<std::uint8_t>& bytes, Vec3 color) {
    for (const double c : {color.x, color.y, color.z})
      bytes.push_back(static_cast<std::uint8_t>(std::lround(shownOf255(c))));
  };
  std::vector<ReflectionOracle::Metal> metals;
  for (const double roughness : ReflectionWall::kRoughness)
    metals.push_back(ReflectionOracle::metalOf(roughness));
  for (std::uint32_t y = ReflectionWall::kSide * ReflectionWall::kRows; y-- > 0;)
    for (std::uint32_t x = 0; x < ReflectionWall::kSide * ReflectionWall::kColumns; ++x) {
      const std::size_t ball =
          (ReflectionWall::kRows - 1 - y / ReflectionWall::kSide) * ReflectionWall::kColumns +
          x / ReflectionWall::kSide;
      Vec3 color;
      const bool inside = wall.truth(oracle, metals[ball], ball, x, y, 0, color, 8);
      const float* texel = picture.at(x, y);
      add(drawn, inside ? Vec3{texel[0], texel[1], texel[2]} : Vec3{});
      add(truth, color);
    }
  std::filesystem::create_directories("out");
  weft::text::Diagnostics said;
  const int width = ReflectionWall::kSide * ReflectionWall::kColumns,
            height = ReflectionWall::kSide * ReflectionWall::kRows;
  CHECK(weft::assets::savePng8("out/reflections_drawn.png", width, height, 3, drawn, said));
  CHECK(weft::assets::savePng8("out/reflections_reference.png", width, height, 3, truth, said));
}
