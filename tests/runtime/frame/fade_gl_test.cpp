// The environment and its lighting as a person sees them: the old ones, or a mix of both that grows with
// time. Never a new sky with old lighting.
#include <algorithm>
#include <cmath>
#include <map>

#include "tests/runtime/stage.h"

namespace frame_fade_test {

using namespace weft;
using namespace weft::runtime::test;

namespace {

constexpr double kStep = 0.05;  // seconds per frame: 6 frames to the new picture

using Map = std::shared_ptr<const assets::EnvironmentMap>;

Map makeMap(std::uint32_t width, std::uint16_t base, std::uint32_t seed) {
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
    stage.settings.window = true;
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
    input.deltaTime = kStep;
    stage.run(input);
    return stage.renderer().readPresentedFloat()->texels;
  }
  Stage stage;
  bool headless;
  int count = 0;
};

// The same ones serve all cases.
Map mapA() {
  static const Map map = makeMap(64, 0x3800, 1);
  return map;
}
Map mapB() {
  static const Map map = makeMap(64, 0x3c00, 7);
  return map;
}
Map mapC() {
  static const Map map = makeMap(128, 0x3400, 3);
  return map;
}

// Null: the stand-in.
const std::vector<float>& finished(const Map& map, const char* elevation = "35") {
  static std::map<std::pair<Map, std::string>, std::vector<float>> known;
  std::vector<float>& picture = known[{map, elevation}];
  if (!picture.empty()) return picture;
  Live live("false", true);
  live.use(map);
  live.set({{"sun_elevation", elevation}});
  return picture = live.frame();
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
    CHECK(farFrom(picture, from, to, std::min(1.0f, static_cast<float>(k) / 6)) < kHalves);
  }
  return waiting;
}

}  // namespace

TEST_CASE(
    "a first environment is there at once, or fades in from black when its lighting takes frames; a later "
    "one fades in from "
    "the one before, with its lighting") {
  const auto a = mapA(), b = mapB(), c = mapC();
  const std::vector<float> seesA = finished(a), seesB = finished(b), seesC = finished(c);
  const std::vector<float> black(seesA.size(), 0.0f);
  REQUIRE(farFrom(seesA, seesB, seesB, 0) > 0.1f);
  for (const char* sliced : {"false", "true"}) {
    CAPTURE(sliced);
    const CleanScope clean;
    Live live(sliced);
    live.use(a);
    if (sliced[0] == 't')
      CHECK(follow(live, black, seesA) > 40);
    else
      CHECK(live.frame() == seesA);
    live.use(b);
    const int second = follow(live, seesA, seesB);
    CHECK((sliced[0] == 't' ? second > 40 : second == 0));
    live.use(c);  // another size
    follow(live, seesB, seesC);
    CHECK(live.frame() == seesC);  // to the bit
  }
}

TEST_CASE("a map that takes the place of the computed sky fades in from it, sky and lighting together") {
  const auto a = mapA();
  const std::vector<float> stoodIn = finished(nullptr), seesA = finished(a);
  const std::vector<float> black(seesA.size(), 0.0f);
  for (const char* sliced : {"false", "true"}) {
    CAPTURE(sliced);
    const CleanScope clean;
    Live live(sliced);
    live.use(nullptr);
    if (sliced[0] == 't') follow(live, black, stoodIn);
    CHECK(live.frame() == stoodIn);
    live.use(a);
    follow(live, stoodIn, seesA);
    CHECK(live.frame() == seesA);
  }
}

TEST_CASE(
    "what comes during a fade is faded to from the picture of then: no frame is further from the one before "
    "than a step") {
  const auto a = mapA(), b = mapB(), c = mapC();
  const std::vector<float> seesA = finished(a), seesB = finished(b), seesC = finished(c);
  for (const char* sliced : {"false", "true"}) {
    CAPTURE(sliced);
    const CleanScope clean;
    Live live(sliced);
    live.use(a);
    // A fade from a picture to itself may round: it is to be over.
    while (live.frame() != seesA && live.count < 100) {
    }
    for (int i = 0; i < 7; ++i) live.frame();
    std::vector<float> last = live.frame();
    REQUIRE(last == seesA);
    live.use(b);
    const auto onwards = [&] {
      std::vector<float> next = live.frame();
      float worst = 0;
      for (std::size_t i = 0; i < next.size(); ++i) {
        const auto [least, most] = std::minmax({seesA[i], seesB[i], seesC[i]});
        const float step = (most - least) * static_cast<float>(kStep / 0.25);
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
    "a parameter of the lighting changed frame after frame: the picture follows in steps, and comes to the "
    "last look") {
  const CleanScope clean;
  const std::vector<float> high = finished(nullptr), low = finished(nullptr, "10");
  Live live("false");
  live.use(nullptr);
  std::vector<float> last = live.frame();
  REQUIRE(last == high);
  for (int k = 1; k <= 5; ++k) {
    live.set({{"sun_elevation", std::to_string(35 - 5 * k)}});
    const std::vector<float> look = finished(nullptr, std::to_string(35 - 5 * k).c_str()),
                             next = live.frame();
    CHECK(next != last);
    CHECK(farFrom(next, last, look, 1.0f / 6) < kHalves);
    last = next;
  }
  for (int k = 1; k <= 5; ++k) last = live.frame();
  CHECK(last == low);
}

TEST_CASE("under a sun that moves the sky and its lighting follow in every frame, at once") {
  const CleanScope clean;
  const auto draw = [](bool headless) {
    Stage stage("graphs/studio.json", 64, 36, "scenes/one_sphere.json");
    stage.settings.sets = {{"sliced", "true"}};
    stage.settings.window = !headless;
    std::vector<std::vector<float>> pictures;
    for (int k = 0; k < 4; ++k) {
      scene::Scene scene = stage.world.scene();
      scene.sun = scene::Sun{.direction = glm::normalize(glm::vec3(1, 0.2f * static_cast<float>(k), 0.5f)),
                             .irradiance = glm::vec3(5)};
      stage.world.setScene(std::move(scene));
      REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
      runtime::FrameInput input = runtime::headlessFrame(stage.world, 0, 60);
      input.headless = headless;
      input.time = 10 + kStep * k;
      input.deltaTime = kStep;
      stage.run(input);
      pictures.push_back(stage.renderer().readPresentedFloat()->texels);
    }
    return pictures;
  };
  const auto still = draw(true);
  CHECK(still[1] != still[2]);
  CHECK(draw(false) == still);
}

TEST_CASE(
    "once a fade is over nothing of it is left: no texture, no other shader, and the next one compiles "
    "nothing") {
  const CleanScope clean;
  const auto a = mapA(), b = mapB();
  Live live("false");
  live.use(a);
  for (int k = 0; k < 20; ++k) live.frame();
  const auto textures = gl::liveObjects(gl::ObjectKind::texture);
  const auto compiled = live.stage.renderer().device().programs.stats().compilations;
  live.use(b);
  live.frame();
  CHECK(gl::liveObjects(gl::ObjectKind::texture) == textures);
  for (int k = 0; k < 20; ++k) live.frame();
  CHECK(gl::liveObjects(gl::ObjectKind::texture) == textures);
  CHECK(live.stage.renderer().device().programs.stats().compilations == compiled);
}

TEST_CASE(
    "headless, nothing fades: frame 0 is the finished picture, and a graph that asks nothing pays nothing") {
  const CleanScope clean;
  const auto a = mapA();
  Live live("true", true);
  live.use(a);
  const std::vector<float> picture = live.frame();
  CHECK(picture == finished(a));
  CHECK(live.frame() == picture);
  CHECK_FALSE(live.stage.execution().remembers(live.stage.world));  // any frame may be the first
}

TEST_CASE(
    "nothing waits for lighting that is not made: without its readers or the pass that makes it the sky is "
    "there") {
  const auto a = mapA();
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

TEST_CASE(
    "what lights a picture is switched off and on again while it fades: the picture comes to that of a fresh "
    "start") {
  for (const bool loaded : {false, true}) {
    CAPTURE(loaded);
    const CleanScope clean;
    Stage stage(withSmallMaps("graphs/studio.json"), 96, 54),
        fresh(withSmallMaps("graphs/studio.json"), 96, 54);
    int count = 0;
    const auto frames = [&](Stage& of, int n) {
      for (int k = 0; k < n; ++k) {
        runtime::FrameInput input = runtime::headlessFrame(of.world, 0, 60);
        input.headless = false;
        input.time = 10 + kStep * count++;
        input.deltaTime = kStep;
        of.run(input);
      }
      return of.pixels();
    };
    for (Stage* each : {&stage, &fresh}) {
      if (loaded) each->world.setEnvironment(mapA());
      REQUIRE_MESSAGE(each->load(), each->diagnostics.text());
    }
    const std::vector<std::uint8_t> wanted = frames(fresh, 10);
    CHECK(frames(stage, 10) == wanted);
    for (const int between : {1, 3, 10}) {
      stage.settings.disables = {"billboards"};
      REQUIRE_MESSAGE(stage.apply(), stage.diagnostics.text());
      frames(stage, between);
      stage.settings.disables.clear();
      REQUIRE_MESSAGE(stage.apply(), stage.diagnostics.text());
      CHECK(frames(stage, 10) == wanted);
    }
  }
}

}  // namespace frame_fade_test
