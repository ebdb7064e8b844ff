// Environments sent beside the one in use, and a graph whose first environment is still on its way.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/imports/environment/environment.h"
#include "tests/runtime/stage.h"

namespace environment_test {

using namespace weft;
using namespace weft::imports;
using namespace weft::runtime;
using namespace weft::runtime::test;

namespace {

EnvironmentProvider::Map makeMap(std::uint32_t width, std::uint32_t height, std::uint32_t seed) {
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

// Calls until it is there.
int sendAll(EnvironmentProvider& textures, const EnvironmentProvider::Map& map,
            text::Diagnostics& diagnostics) {
  int calls = 0;
  float before = 0;
  for (std::optional<float> sent; !sent || *sent < 1; before = *sent) {
    sent = textures.send(map, diagnostics);
    REQUIRE(sent);
    CHECK(*sent >= before);
    REQUIRE(++calls < 100000);
  }
  return calls;
}

}  // namespace

TEST_CASE("an environment that was sent in portions is the one uploaded at once, with every level") {
  context();
  const CleanScope scope;
  text::Diagnostics diagnostics;
  EnvironmentProvider sent, direct;
  for (const auto& map : {makeMap(2048, 1024, 1), makeMap(37, 19, 2), makeMap(1, 1, 3), makeMap(1500, 750, 4),
                          makeMap(1501, 751, 5)}) {  // no powers of two
    const int calls = sendAll(sent, map, diagnostics);
    CHECK(static_cast<std::size_t>(calls) >= map->texels.size() * 2 / EnvironmentProvider::kBytesPerFrame);
    REQUIRE(sent.use(map, diagnostics));
    REQUIRE(direct.use(map, diagnostics));
    CHECK(sent.hold()->ref().desc == direct.hold()->ref().desc);
    CHECK(levelsOf(sent.hold()->ref()) == levelsOf(direct.hold()->ref()));
  }
  CHECK(diagnostics.empty());
}

TEST_CASE("the environment in use stays as it is while another is sent, dropped, or replaced on the way") {
  context();
  const CleanScope scope;
  text::Diagnostics diagnostics;
  EnvironmentProvider textures;
  const auto a = makeMap(64, 32, 1), b = makeMap(2048, 1024, 2), c = makeMap(32, 16, 3);
  REQUIRE(textures.use(a, diagnostics));
  const gl::TextureRef first = textures.hold()->ref();
  const auto levels = levelsOf(first);
  const auto objects = gl::liveObjects();
  textures.send(b, diagnostics);
  CHECK(textures.hold()->id() == first.id);
  textures.stopSending();
  CHECK(gl::liveObjects() == objects);
  textures.send(b, diagnostics);
  sendAll(textures, c, diagnostics);
  CHECK(levelsOf(textures.hold()->ref()) == levels);
  const auto alive = [] { return gl::liveObjects(gl::ObjectKind::texture); };
  CHECK(alive() == 2);
  REQUIRE(textures.use(c, diagnostics));
  CHECK(textures.hold()->ref().desc.width == 32);
  CHECK(alive() == 1);
  // Taken before all of it was sent: uploaded at once. What somebody holds stays.
  auto held = textures.hold();
  textures.send(b, diagnostics);
  REQUIRE(textures.use(b, diagnostics));
  CHECK(textures.hold()->ref().desc.width == 2048);
  CHECK(alive() == 2);
  REQUIRE(textures.use(a, diagnostics));
  CHECK(alive() == 2);
  held.reset();
  CHECK(alive() == 1);
}

TEST_CASE("an environment that the GPU has is not kept on the CPU, and stays through changes of the graph") {
  const CleanScope scope;
  Stage stage("tests/runtime/graphs/fade.json", 32, 18);
  stage.world.setEnvironment(makeMap(64, 32, 1));
  CHECK(stage.world.facts().environmentWidth == 64);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.renderer().dropUploaded(stage.world);
  CHECK_FALSE(stage.world.environment()->texels.empty());  // no frame has sent it
  stage.run(0);
  const auto picture = stage.renderer().readPresentedFloat()->texels;
  stage.renderer().dropUploaded(stage.world);
  CHECK(stage.world.environment()->texels.empty());
  CHECK(stage.world.dropEnvironmentTexels() == 0);
  CHECK(stage.world.facts().environmentWidth == 64);
  stage.run(1);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(2);
  CHECK(stage.renderer().readPresentedFloat()->texels == picture);
  for (const char* name : {"ibl.irradiance_map", "ibl.luminance_rows"}) CHECK_FALSE(stage.ran(name));
  stage.world.setEnvironment(makeMap(64, 32, 9));
  REQUIRE_MESSAGE(stage.apply(), stage.diagnostics.text());
  for (std::uint32_t frame = 3; frame < 25; ++frame) stage.run(frame);
  CHECK(stage.renderer().readPresentedFloat()->texels != picture);
  CHECK(stage.world.dropEnvironmentTexels() == 64 * 32 * 8);
}

TEST_CASE("a map that the GPU cannot hold is refused, and the one in use stays") {
  context();
  const CleanScope scope;
  text::Diagnostics diagnostics;
  EnvironmentProvider textures;
  const auto good = makeMap(8, 4, 1);
  auto wide = std::make_shared<assets::EnvironmentMap>(assets::EnvironmentMap{1u << 20, 1, {}});
  wide->texels.resize(std::size_t{4} << 20);
  REQUIRE(textures.use(good, diagnostics));
  CHECK(!textures.send(wide, diagnostics));
  CHECK(!textures.use(wide, diagnostics));
  CHECK(diagnostics.contains(text::Code::textureNotCreated));
  CHECK(textures.hold()->ref().desc.width == 8);
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
    text::Diagnostics diagnostics;
    sendAll(*late.renderer().device().imports.find<EnvironmentProvider>(), map, diagnostics);
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
  const auto& imports = stage.execution().plan().graph->imports;
  const auto import =
      std::ranges::find(imports, "environment", [](const auto& each) { return each.request.type; });
  REQUIRE(import != imports.end());
  const gl::TextureRef texture = stage.renderer().device().imports.texture(*import, stage.diagnostics);
  REQUIRE(texture.desc.mips == 11);
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
