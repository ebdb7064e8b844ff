// Live parameters on the GPU: set between frames they make no plan and no allocation, give the picture of a
// graph that was loaded with them, and wake what runs on change.
#include <cmath>
#include <cstring>

#include "engine/text/hash.h"
#include "tests/runtime/frame_allocations.h"
#include "tests/runtime/stage.h"

namespace frame_live_test {

using namespace weft;
using namespace weft::graph;
using namespace weft::runtime;
using namespace weft::runtime::test;

namespace {

bool sameBytes(std::span<const std::byte> a, std::span<const std::byte> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace

TEST_CASE("live: two hundred changes build no plan, allocate nothing, and give the picture of a fresh run") {
  const CleanScope clean;
  Stage stage(withSmallMaps("graphs/studio.json"));
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  for (std::uint32_t frame = 0; frame < 3; ++frame) stage.run(frame);
  const std::uint64_t plans = stage.renderer().plansBuilt();
  const auto first = stage.pixels();
  const struct {
    const char* path;
    double from, step;
  } sliders[] = {
      {"post.display.exposure", -2, 0.01}, {"post.threshold", 0.1, 0.02}, {"post.fxaa.subpixel", 0, 0.004}};
  const FrameInput input = headlessFrame(stage.world, 3, 60);
  std::size_t allocations = 0;
  for (int i = 0; i < 200; ++i) {
    startCountingAllocations();
    for (const auto& slider : sliders)
      if (!stage.renderer().setParameter(slider.path, Value::number(slider.from + slider.step * i)))
        FAIL(slider.path);
    allocations += stopCountingAllocations();
    if (i % 50 != 0) continue;
    stage.run(3);  // once for what a first frame needs
    startCountingAllocations();
    stage.renderer().frame(stage.world, input, stage.diagnostics);
    allocations += stopCountingAllocations();
  }
  CHECK(allocations == 0);
  CHECK(stage.renderer().plansBuilt() == plans);
  stage.run(3);
  const auto live = stage.pixels();
  CHECK(live != first);

  Stage fresh(withSmallMaps("graphs/studio.json"));
  for (const auto& slider : sliders)
    fresh.settings.sets.emplace_back(slider.path, Value::number(slider.from + slider.step * 199),
                                     Origin::panel);
  REQUIRE_MESSAGE(fresh.load(), fresh.diagnostics.text());
  for (std::uint32_t frame = 0; frame < 4; ++frame) fresh.run(frame);
  CHECK(live == fresh.pixels());
  CHECK(sameBytes(stage.execution().uniforms().bytes(), fresh.execution().uniforms().bytes()));
}

TEST_CASE("live: every live parameter of the studio, one after the other, leaves the bytes of a fresh run") {
  const CleanScope clean;
  Stage stage(withSmallMaps("graphs/studio.json"), 64, 36);
  stage.settings.sets = {
      {"dof", "true"}, {"motion_blur", "true"}, {"auto_exposure", "true"}, {"fog", "true"}};
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  const auto& parameters = stage.execution().plan().graph->parameters;
  Stage fresh(withSmallMaps("graphs/studio.json"), 64, 36);
  fresh.settings = stage.settings;
  std::size_t set = 0;
  for (const ParameterSpec& parameter : parameters) {
    Value value = parameter.value;
    if (parameter.structural || value.type == Value::Type::symbol) continue;
    for (std::size_t i = 0; i < value.count; ++i) {
      const double step =
          parameter.desc.min && parameter.desc.max ? (*parameter.desc.max - *parameter.desc.min) / 37 : 0.375;
      const double to = value.v[i] + step;
      value.v[i] = value.type == Value::Type::boolean                    ? 1 - value.v[i]
                   : parameter.desc.type == ParameterDesc::Type::integer ? value.v[i] + 1
                   : parameter.desc.max && to > *parameter.desc.max      ? value.v[i] - step
                                                                         : to;
    }
    INFO(parameter.path);
    REQUIRE(stage.renderer().setParameter(parameter.path, value));
    fresh.settings.sets.emplace_back(parameter.path, value, Origin::panel);
    ++set;
  }
  CHECK(set > 35);
  REQUIRE_MESSAGE(fresh.load(), fresh.diagnostics.text());
  for (const std::uint32_t frame : {0u, 1u}) {  // before which all are set: the sky's would fade in later
    fresh.run(frame);
    stage.run(frame);
  }
  CHECK(sameBytes(stage.execution().uniforms().bytes(), fresh.execution().uniforms().bytes()));
}

TEST_CASE("live: a pass that runs on change wakes, and what it feeds; the rest is kept") {
  const CleanScope clean;
  Stage stage(withSmallMaps("graphs/studio.json"), 64, 36);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(0);
  stage.run(1);
  CHECK_FALSE(stage.ran("ibl.daylight.daylight_sky"));
  const std::uint64_t plans = stage.renderer().plansBuilt();
  REQUIRE(stage.renderer().setParameter("ibl.daylight.sun_elevation", Value::number(10)));
  stage.run(2);
  for (const char* again : {"ibl.daylight.daylight_sky", "ibl.daylight.daylight_mips[2]",
                            "ibl.irradiance_map", "ibl.specular_prefilter[1]"})
    CHECK_MESSAGE(stage.ran(again), again);
  CHECK_FALSE(stage.ran("ibl.brdf_table"));
  CHECK(stage.renderer().plansBuilt() == plans);
  stage.run(3);
  CHECK_FALSE(stage.ran("ibl.daylight.daylight_sky"));
  // The same value again is no change.
  REQUIRE(stage.renderer().setParameter("ibl.daylight.sun_elevation", Value::number(10)));
  stage.run(4);
  CHECK_FALSE(stage.ran("ibl.daylight.daylight_sky"));
}

TEST_CASE("live: values with age(), lets and repeats are those of a run that began with them") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/live.json", 8, 8, "scenes/empty.json");
  Stage fresh("tests/runtime/graphs/live.json", 8, 8, "scenes/empty.json");
  fresh.settings.sets = {{"gain", "16"}, {"slow", "7"}, {"speed", "2.5"}};
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  REQUIRE_MESSAGE(fresh.load(), fresh.diagnostics.text());
  for (const ParameterSpec& parameter : stage.execution().plan().graph->parameters)
    CHECK(parameter.structural == (parameter.path == "count"));
  FrameInput input = headlessFrame(stage.world, 0, 60);
  input.headless = false;  // so that ages are times
  for (int frame = 0; frame < 5; ++frame) {
    input.frame = static_cast<std::uint32_t>(frame);
    input.time = frame * 0.125;
    if (frame == 0) {
      REQUIRE(stage.renderer().setParameter("gain", Value::number(16)));
      REQUIRE(stage.renderer().setParameter("slow", Value::number(7)));
      REQUIRE(stage.renderer().setParameter("speed", Value::number(2.5)));
    }
    stage.run(input);
    fresh.run(input);
    CHECK(stage.value() == fresh.value());
    CHECK(stage.value() == doctest::Approx((70 + 0.5) * 2 + frame * 0.125 * 2.5));
  }
}

TEST_CASE("live: what is no live value changes nothing") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/live.json", 8, 8, "scenes/empty.json");
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(0);
  const float before = stage.value();
  const std::vector<std::byte> bytes(stage.execution().uniforms().bytes().begin(),
                                     stage.execution().uniforms().bytes().end());
  const auto set = [&](const char* path, const Value& value) {
    return stage.renderer().setParameter(path, value);
  };
  CHECK_FALSE(set("count", Value::number(2)));     // structural
  CHECK_FALSE(set("nothing", Value::number(2)));   // unknown
  CHECK_FALSE(set("gain", Value::number(1000)));   // out of its range
  CHECK_FALSE(set("gain", Value::boolean(true)));  // of another type
  CHECK_FALSE(set("gain", Value::number(0)));      // 8 / 0
  CHECK(sameBytes(stage.execution().uniforms().bytes(), bytes));
  CHECK(stage.execution().uniforms().parameters()[0] == Value::number(2));
  stage.run(1);
  CHECK(stage.value() == before);
  // The way that makes another plan says why.
  stage.settings.sets = {{"gain", "0"}};
  CHECK_FALSE(stage.apply());
  CHECK_MESSAGE(stage.diagnostics.contains(text::Code::noFiniteResult), stage.diagnostics.text());
}

TEST_CASE("live: another plan begins with the values it is made with") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/live.json", 8, 8, "scenes/empty.json");
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(0);
  REQUIRE(stage.renderer().setParameter("gain", Value::number(4)));
  stage.settings.sets = {{"gain", "4"}, {"count", "3"}};
  REQUIRE_MESSAGE(stage.apply(), stage.diagnostics.text());
  stage.run(1);
  CHECK(stage.execution().uniforms().parameters()[0] == Value::number(4));
  CHECK_FALSE(stage.ran("kept"));
  REQUIRE(stage.renderer().setParameter("gain", Value::number(8)));
  stage.run(2);
  CHECK(stage.value() == (50 + 1) * 24 + 1000);
}

TEST_CASE("toggle: only passes that differ are prepared, and the picture is that of a fresh run") {
  const CleanScope clean;
  Stage stage(withSmallMaps("graphs/studio.json"));
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(0);
  const auto all = static_cast<std::uint32_t>(stage.execution().plan().steps.size());
  CHECK(stage.execution().passesPrepared() == all);
  const auto first = stage.pixels();
  const struct {
    const char *name, *value;
    std::uint32_t most;  // that differ, or whose storage another one has now
  } toggles[] = {{"vignette", "true", 1},
                 {"grain", "true", 1},
                 {"bloom", "false", 4},
                 {"fxaa", "false", 2},
                 {"specular_aa", "false", 2}};  // the spheres, and those of a fade
  for (const auto& toggle : toggles) {
    INFO(std::string(toggle.name));
    stage.settings.sets = {{toggle.name, toggle.value}};
    REQUIRE_MESSAGE(stage.apply(), stage.diagnostics.text());
    CHECK(stage.execution().passesPrepared() <= toggle.most);
    stage.run(0);
    CHECK_FALSE(stage.ran("ibl.brdf_table"));
    Stage fresh(withSmallMaps("graphs/studio.json"));
    fresh.settings.sets = stage.settings.sets;
    REQUIRE_MESSAGE(fresh.load(), fresh.diagnostics.text());
    fresh.run(0);
    CHECK(stage.pixels() == fresh.pixels());
    stage.settings.sets.clear();
    REQUIRE_MESSAGE(stage.apply(), stage.diagnostics.text());
    stage.run(0);
    CHECK(stage.pixels() == first);
    REQUIRE_MESSAGE(stage.apply(), stage.diagnostics.text());  // nothing changed
    CHECK(stage.execution().passesPrepared() == 0);
    stage.run(0);
  }
  CHECK(stage.pixels() == first);
  // A saved file is read and every shader looked at, but what is the same is not prepared again.
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  CHECK(stage.execution().passesPrepared() == 0);
  stage.run(0);
  CHECK(stage.pixels() == first);
}

TEST_CASE("live: arrays and matrices reach the shader in the order of its own indices") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/arrays.json", 36, 1);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  const auto row = [&] {
    stage.run(0);
    const std::vector<float> texels = stage.read("row");
    std::vector<float> numbers;
    for (std::size_t i = 0; i < texels.size(); i += 4) numbers.push_back(texels[i]);
    return numbers;
  };
  std::vector<float> expected;
  for (int i = 0; i < 36; ++i) expected.push_back(static_cast<float>(i));
  CHECK(row() == expected);
  const std::uint64_t plans = stage.renderer().plansBuilt();
  REQUIRE(stage.renderer().setParameter("gain", Value::number(5)));
  REQUIRE(stage.renderer().setParameter("shift", {Value::Type::list, 2, {100, 200, 0, 0}, {}}));
  expected[2] = 10;
  expected[9] = 109;
  expected[10] = 210;
  CHECK(row() == expected);
  CHECK(stage.renderer().plansBuilt() == plans);
}

TEST_CASE("live: values of imports follow the world frame by frame, and wake a pass that is on_change") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/follow.json", 16, 9, "tests/runtime/graphs/follow_scene.json");
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  const std::uint64_t plans = stage.renderer().plansBuilt();
  FrameInput input = headlessFrame(stage.world, 0, 60);
  const auto run = [&](std::uint32_t frame) {
    input.frame = frame;
    stage.run(input);
    const std::vector<float> texels = stage.read("row");
    std::vector<double> numbers;
    for (std::size_t i = 0; i < texels.size(); i += 4) numbers.push_back(texels[i]);
    return numbers;
  };
  const auto isNear = [](std::span<const double> found, std::vector<double> wanted) {
    for (std::size_t i = 0; i < wanted.size(); ++i)
      CHECK(found[i] == doctest::Approx(wanted[i]).epsilon(1e-5));
  };
  input.pose = {.position = {1, 2, 3}, .target = {1, 2, -5}, .fovDegrees = 40, .nearPlane = 0.25};
  const std::vector<double> first = run(0);
  isNear(first, {1, 2, 3, 0, 0, -1});
  isNear(std::span(first).subspan(6), {2 * 0.6, 0, 2 * -0.8, 0.25, 40, 7});  // as follow_scene.json says
  CHECK(stage.read("same")[0] == 0);
  run(1);
  CHECK_FALSE(stage.ran("kept"));
  input.pose.position = {4, 2, -5};
  isNear(run(2), {4, 2, -5, -1, 0, 0});
  CHECK(stage.ran("kept"));
  CHECK(stage.read("same")[0] == 0);
  CHECK(stage.renderer().plansBuilt() == plans);
}

}  // namespace frame_live_test
