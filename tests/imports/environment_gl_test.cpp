// Environments on the GPU, and a graph whose first environment is still on its way.
#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <numbers>

#include "engine/imports/environment/environment.h"
#include "tests/runtime/stage.h"

namespace environment_test {

using namespace weft;
using namespace weft::imports;
using namespace weft::runtime;
using namespace weft::runtime::test;

namespace {

std::shared_ptr<const assets::EnvironmentMap> makeMap(std::uint32_t width, std::uint32_t height,
                                                      std::uint32_t seed) {
  auto map = std::make_shared<assets::EnvironmentMap>();
  map->width = width;
  map->height = height;
  for (std::uint32_t i = 0; i < width * height * 4; ++i)
    map->texels.push_back(
        i % 4 == 3 ? 0x3c00 : static_cast<std::uint16_t>(0x3000 + (i * 2654435761u + seed) % 0x0800));
  return map;
}

std::vector<std::vector<float>> levelsOf(const gl::TextureRef& texture) {
  std::vector<std::vector<float>> levels;
  for (std::uint32_t mip = 0; mip < texture.desc.mips; ++mip) levels.push_back(gl::readFloats(texture, mip));
  return levels;
}

// What a graph that imports the environment has of it.
gl::TextureRef textureOf(Stage& stage) {
  const auto& imports = stage.execution().plan().graph->imports;
  const auto import =
      std::ranges::find(imports, "environment", [](const auto& each) { return each.request.type; });
  REQUIRE(import != imports.end());
  return stage.renderer().device().imports.texture(*import, stage.diagnostics);
}

}  // namespace

TEST_CASE(
    "an environment is on the GPU as it is in memory, with every level, and the one before it is gone") {
  const CleanScope scope;
  Stage stage("tests/runtime/graphs/fade.json", 32, 18);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  std::int64_t alive = 0;
  std::uint32_t frame = 0;
  for (const auto& map : {makeMap(2048, 1024, 1), makeMap(37, 19, 2), makeMap(1, 1, 3), makeMap(1500, 750, 4),
                          makeMap(1501, 751, 5)}) {  // no powers of two
    CAPTURE(map->width);
    stage.world.setEnvironment(map);
    REQUIRE_MESSAGE(stage.apply(), stage.diagnostics.text());
    for (int i = 0; i < 40; ++i) stage.run(frame++);
    const gl::TextureRef texture = textureOf(stage);
    CHECK(texture.desc.width == map->width);
    CHECK(texture.desc.mips == gl::mipsOf(map->width, map->height));
    const auto levels = levelsOf(texture);
    REQUIRE(levels[0].size() == map->texels.size());
    CHECK(std::ranges::equal(levels[0], map->texels, {}, {}, glm::unpackHalf1x16));
    for (const auto& level : levels) CHECK(std::ranges::all_of(level, [](float texel) { return texel > 0; }));
    if (alive == 0) alive = gl::liveObjects(gl::ObjectKind::texture);
    CHECK(gl::liveObjects(gl::ObjectKind::texture) == alive);
  }
}

TEST_CASE(
    "an environment stays through changes of the graph, and is uploaded again only when it is another") {
  const CleanScope scope;
  Stage stage("tests/runtime/graphs/fade.json", 32, 18);
  stage.world.setEnvironment(makeMap(64, 32, 1));
  CHECK(stage.world.facts().environmentWidth == 64);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(0);
  const auto picture = stage.renderer().readPresentedFloat()->texels;
  const auto texture = textureOf(stage).id;
  stage.run(1);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(2);
  CHECK(textureOf(stage).id == texture);
  CHECK(stage.renderer().readPresentedFloat()->texels == picture);
  for (const char* name : {"ibl.irradiance_map", "ibl.luminance_rows"}) CHECK_FALSE(stage.ran(name));
  stage.world.setEnvironment(makeMap(64, 32, 9));
  REQUIRE_MESSAGE(stage.apply(), stage.diagnostics.text());
  for (std::uint32_t frame = 3; frame < 25; ++frame) stage.run(frame);
  CHECK(stage.renderer().readPresentedFloat()->texels != picture);
}

TEST_CASE("a map that the GPU cannot hold is refused, and the one in use stays") {
  const CleanScope scope;
  Stage stage("tests/runtime/graphs/fade.json", 32, 18);
  const auto wide = std::make_shared<assets::EnvironmentMap>(assets::EnvironmentMap{1u << 20, 1, {}});
  wide->texels.resize(std::size_t{4} << 20);
  text::Diagnostics diagnostics;
  stage.world.setEnvironment(makeMap(8, 4, 1));
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(0);
  CHECK(!EnvironmentProvider::create(*wide, diagnostics));
  CHECK(diagnostics.contains(text::Code::textureNotCreated));
  stage.world.setEnvironment(wide);
  CHECK(textureOf(stage).desc.width == 8);
  CHECK(stage.diagnostics.contains(text::Code::textureNotCreated));
}

TEST_CASE(
    "black until the first environment is there, then the picture that one loaded before frame 0 gives") {
  for (const char* graph : {"graphs/glow.json", "graphs/studio.json"}) {
    CAPTURE(graph);
    context();
    const CleanScope scope;
    Stage late(withSmallMaps(graph), 64, 36), early(withSmallMaps(graph), 64, 36);
    const auto map = makeMap(128, 64, 5);  // not the size that is assumed meanwhile
    late.world.expectEnvironment();
    REQUIRE(late.load());
    for (std::uint32_t frame = 0; frame < 3; ++frame) {
      late.run(frame);
      const auto pixels = late.pixels();
      for (std::size_t i = 0; i < pixels.size(); ++i) REQUIRE(pixels[i] == (i % 4 == 3 ? 255 : 0));
    }
    late.world.setEnvironment(map);
    CHECK(!late.world.environmentPending());
    REQUIRE(late.renderer().apply(late.settings, late.world, late.diagnostics));
    early.world.setEnvironment(map);
    REQUIRE(early.load());
    late.run(0);
    early.run(0);
    CHECK(late.pixels() == early.pixels());
  }
}

TEST_CASE(
    "a graph that reads no environment does not wait for one; a first environment that fails leaves the "
    "stand-in") {
  context();
  const CleanScope scope;
  Stage stage("tests/runtime/graphs/toggle.json", 32, 18), sky("graphs/glow.json", 32, 18),
      wanted("graphs/glow.json", 32, 18);
  stage.world.expectEnvironment();
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  text::Diagnostics diagnostics;
  CHECK(stage.renderer().frame(stage.world, headlessFrame(stage.world, 0, 60), diagnostics).passesRun > 0);
  sky.world.expectEnvironment();
  REQUIRE(sky.load());
  sky.run(0);
  sky.world.expectEnvironment(false);
  REQUIRE(sky.renderer().apply(sky.settings, sky.world, sky.diagnostics));
  REQUIRE(wanted.load());
  sky.run(1);
  wanted.run(1);
  CHECK(sky.pixels() == wanted.pixels());
}

TEST_CASE("the stand-in for an environment has all its levels") {
  context();
  const CleanScope scope;
  Stage stage("graphs/glow.json", 32, 18);
  REQUIRE(stage.load());
  stage.run(0);
  const gl::TextureRef texture = textureOf(stage);
  REQUIRE(texture.desc.mips == std::bit_width(texture.desc.width));
  // Over the sphere: rows shrink to the poles. Twice as wide as high, but for the last level.
  const auto meanOf = [](const std::vector<float>& texels) {
    const auto height =
        std::max(static_cast<std::size_t>(std::sqrt(static_cast<double>(texels.size()) / 8)), std::size_t{1});
    const std::size_t row = texels.size() / height;
    double sum = 0, shares = 0;
    for (std::size_t i = 0; i < texels.size(); i += 4) {
      const double share =
          std::sin((static_cast<double>(i / row) + 0.5) * std::numbers::pi / static_cast<double>(height));
      sum += share * static_cast<double>(texels[i] + texels[i + 1] + texels[i + 2]);
      shares += share;
    }
    return sum / shares;
  };
  const auto levels = levelsOf(texture);
  for (const auto& level : levels) {
    CAPTURE(level.size());
    CHECK(meanOf(level) == doctest::Approx(meanOf(levels[0])).epsilon(0.02));
  }
}

}  // namespace environment_test
