// The environment and its lighting as a person sees them: the old ones, or a mix of both that grows with
// time, from black at first. Never a new sky with old lighting.
#include <algorithm>
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
  void set(std::vector<weft::graph::Setting> sets) {
    stage.settings.sets = {stage.settings.sets[0]};
    stage.settings.sets.insert(stage.settings.sets.end(), sets.begin(), sets.end());
    REQUIRE_MESSAGE(stage.apply(), stage.diagnostics.text());
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

// Null: the stand-in.
std::vector<float> finished(std::shared_ptr<const assets::EnvironmentMap> map, const char* elevation = "35") {
  Live live("false", true);
  live.use(std::move(map));
  live.set({{"sun_elevation", elevation}});
  return live.frame();
}

constexpr float kHalves = 0.004f;  // blending of a few layers, each rounded

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

TEST_CASE("a map that takes the place of the computed sky fades in from it, sky and lighting together") {
  const auto a = makeMap(64, 0x3800, 1);
  const std::vector<float> stoodIn = finished(nullptr), seesA = finished(a);
  const std::vector<float> black(seesA.size(), 0.0f);
  for (const char* sliced : {"false", "true"}) {
    CAPTURE(sliced);
    const CleanScope clean;
    Live live(sliced);
    live.use(nullptr);
    follow(live, black, stoodIn);
    CHECK(live.frame() == stoodIn);
    live.use(a);
    follow(live, stoodIn, seesA);
    CHECK(live.frame() == seesA);
  }
  const CleanScope clean;
  Live live("false");  // the map comes while the sky fades in
  live.use(nullptr);
  for (int k = 0; k < 3; ++k) live.frame();
  live.use(a);
  for (int k = 3; k < 5; ++k)
    CHECK(farFrom(live.frame(), black, stoodIn, static_cast<float>(k * kStep / 0.25)) < kHalves);
  follow(live, stoodIn, seesA);
  CHECK(live.frame() == seesA);
}

TEST_CASE("what comes during a fade waits for its end: no frame is further from the one before than a step") {
  const auto a = makeMap(64, 0x3800, 1), b = makeMap(64, 0x3c00, 7), c = makeMap(128, 0x3400, 3);
  const std::vector<float> seesA = finished(a), seesB = finished(b), seesC = finished(c);
  for (const char* sliced : {"false", "true"}) {
    CAPTURE(sliced);
    const CleanScope clean;
    Live live(sliced);
    live.use(a);
    while (live.frame() != seesA && live.count < 100) {
    }
    std::vector<float> last = live.frame();
    REQUIRE(last == seesA);
    live.use(b);
    const auto onwards = [&] {
      std::vector<float> next = live.frame();
      float worst = 0;
      for (std::size_t i = 0; i < next.size(); ++i) {
        const float step = std::max(std::abs(seesA[i] - seesB[i]), std::abs(seesB[i] - seesC[i])) *
                           static_cast<float>(kStep / 0.25);
        worst = std::max(worst, (std::abs(next[i] - last[i]) - step) / std::max(1.0f, next[i]));
      }
      CHECK(worst < kHalves);
      last = std::move(next);
    };
    while (farFrom(last, seesA, seesA, 0) < kHalves && live.count < 200) onwards();
    live.use(c);
    while (last != seesC && live.count < 300) onwards();
    CHECK(last == seesC);
  }
}

TEST_CASE(
    "a parameter of the lighting changed during a fade, frame after frame: each look is faded to in turn") {
  const CleanScope clean;
  const std::vector<float> high = finished(nullptr), low = finished(nullptr, "10");
  const std::vector<float> black(high.size(), 0.0f);
  Live live("false");
  live.use(nullptr);
  live.frame();
  for (int k = 1; k <= 4; ++k) {
    live.set({{"sun_elevation", std::to_string(35 - 5 * k)}});
    CHECK(farFrom(live.frame(), black, high, static_cast<float>(k * kStep / 0.25)) < kHalves);
  }
  live.set({{"sun_elevation", "10"}});
  follow(live, high, low);
  CHECK(live.frame() == low);
}

TEST_CASE(
    "once a fade is over nothing of it is left: no texture, no other shader, and the next one compiles "
    "nothing") {
  const CleanScope clean;
  const auto a = makeMap(64, 0x3800, 1), b = makeMap(64, 0x3c00, 7);
  Live live("false");
  live.use(a);
  for (int k = 0; k < 20; ++k) live.frame();
  const auto textures = gl::liveObjects().of(gl::ObjectKind::texture);
  const auto compiled = live.stage.renderer().device().programs.stats().compilations;
  live.use(b);
  live.frame();
  CHECK(gl::liveObjects().of(gl::ObjectKind::texture) == textures + 1);  // the map shown before
  for (int k = 0; k < 20; ++k) live.frame();
  CHECK(gl::liveObjects().of(gl::ObjectKind::texture) == textures);
  CHECK(live.stage.renderer().device().programs.stats().compilations == compiled);
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
    for (const graph::UniformSpec& uniform : spec.uniforms)
      CHECK(uniform.role != graph::UniformSpec::Role::define);
}

TEST_CASE(
    "nothing waits for lighting that is not made: without its readers or the pass that makes it the sky is "
    "there") {
  const auto a = makeMap(64, 0x3800, 1);
  for (const char* disabled : {"lit.billboards", "specular_prefilter"}) {
    CAPTURE(disabled);
    const CleanScope clean;
    Live live("false"), still("false", true);
    for (Live* each : {&live, &still}) {
      each->stage.settings.disables = {disabled};
      each->use(a);
    }
    for (int k = 0; k < 10; ++k) live.frame();
    const std::vector<float> picture = live.frame();
    CHECK(*std::ranges::max_element(picture) > 0);
    CHECK(picture == still.frame());
  }
}
