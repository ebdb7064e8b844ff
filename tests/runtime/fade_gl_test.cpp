// The environment and its lighting as a person sees them: the old ones, or a mix of both that grows with
// time, from black at first. Never a new sky with old lighting.
#include <cmath>

#include "tests/runtime/stage.h"

using namespace weft;
using namespace weft::runtime::test;

namespace {

constexpr double kStep = 0.05;  // seconds per frame: 5 frames of fade

std::shared_ptr<const assets::EnvironmentMap> makeMap(std::uint32_t width, std::uint16_t base,
                                                      std::uint32_t seed) {
  auto map = std::make_shared<assets::EnvironmentMap>();
  map->width = width;
  map->height = width / 2;
  for (std::uint32_t i = 0; i < width * width * 2; ++i)
    map->texels.push_back(
        i % 4 == 3 ? 0x3c00 : static_cast<std::uint16_t>(base + (i / 64 * 2654435761u + seed) % 0x0400));
  return map;
}

struct Live {
  Live(const char* sliced, bool isHeadless = false)
      : stage("tests/runtime/graphs/fade.json", 64, 36), headless(isHeadless) {
    stage.settings.sets = {{"ibl.sliced", sliced}};
  }
  void use(std::shared_ptr<const assets::EnvironmentMap> map) {
    stage.world.setEnvironment(std::move(map));
    REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  }
  std::vector<float> frame() {
    runtime::FrameInput input = runtime::headlessFrame(stage.world, 0, 60);
    input.headless = headless;
    input.time = 10 + kStep * count++;
    stage.run(input);
    return stage.renderer().readPresentedFloat()->texels;
  }
  Stage stage;
  bool headless;
  int count = 0;
};

std::vector<float> finished(std::shared_ptr<const assets::EnvironmentMap> map) {
  Live live("false", true);
  live.use(std::move(map));
  return live.frame();
}

// The greatest difference of `picture` from mix(from, to, part), with half floats' precision taken off.
float farFrom(const std::vector<float>& picture, const std::vector<float>& from, const std::vector<float>& to,
              float part) {
  float worst = 0;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (i % 4 == 3) continue;  // coverage of the scene, not light
    const float wanted = from[i] + (to[i] - from[i]) * part;
    worst = std::max(worst, std::abs(picture[i] - wanted) / std::max(1.0f, wanted));
  }
  return worst;
}

// Frames until the whole of `to`: first all `from`, then the fade, frame by frame. How many were wholly
// `from`.
int follow(Live& live, const std::vector<float>& from, const std::vector<float>& to) {
  constexpr float kHalves = 0.004f;  // blending of a few layers, each rounded
  int waiting = 0;
  std::vector<float> picture = live.frame();
  for (; farFrom(picture, from, to, 0) < kHalves && waiting < 200; picture = live.frame()) ++waiting;
  for (int k = 1; k <= 6; ++k, picture = live.frame()) {
    CAPTURE(k);
    CHECK(farFrom(picture, from, to, std::min(1.0f, static_cast<float>(k * kStep / 0.25))) < kHalves);
  }
  return waiting;
}

}  // namespace

TEST_CASE("a first environment fades in from black, a later one from the one before, with its lighting") {
  const auto a = makeMap(64, 0x3800, 1), b = makeMap(64, 0x3c00, 7), c = makeMap(128, 0x3400, 3);
  const std::vector<float> seesA = finished(a), seesB = finished(b), seesC = finished(c);
  const std::vector<float> black(seesA.size(), 0.0f);
  REQUIRE(farFrom(seesA, seesB, seesB, 0) > 0.1f);
  for (const char* sliced : {"false", "true"}) {
    CAPTURE(sliced);
    const CleanScope clean;
    Live live(sliced);
    live.use(a);
    const int first = follow(live, black, seesA);
    CHECK((sliced[0] == 't' ? first > 40 : first == 1));
    live.use(b);
    const int second = follow(live, seesA, seesB);
    CHECK((sliced[0] == 't' ? second > 40 : second == 1));
    live.use(c);  // another size
    follow(live, seesB, seesC);
    CHECK(live.frame() == seesC);  // to the bit
  }
}

TEST_CASE(
    "headless, nothing fades: frame 0 is the finished picture, and a graph that asks nothing pays nothing") {
  const CleanScope clean;
  const auto a = makeMap(64, 0x3800, 1);
  Live live("true", true);
  live.use(a);
  const std::vector<float> picture = live.frame();
  CHECK(picture == finished(a));
  CHECK(live.frame() == picture);
  const graph::FlatGraph& graph = *live.stage.execution().plan().graph;
  for (const graph::PassSpec& spec : graph.specs)
    for (const graph::UniformSpec& uniform : spec.uniforms) CHECK(uniform.define == (uniform.name == "FADE"));
}
