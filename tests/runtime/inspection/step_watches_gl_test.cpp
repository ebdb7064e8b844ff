// What a watch sees of each step: the record of every pass, also where its storage is used again, and what poison does.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/graph/subresource.h"
#include "engine/runtime/inspection/step_watches.h"
#include "tests/runtime/stage.h"

namespace inspection_step_watches_test {

using namespace weft;
using namespace weft::runtime;
using namespace weft::runtime::test;

namespace {

constexpr const char* kRecorded = "tests/theory/inspect.json";

std::vector<StepRecord> recordFrame(Stage& stage, StepRecorder& recorder) {
  stage.execution().watch({.after = [&](std::uint32_t step) { recorder.look(stage.execution(), step); }});
  stage.run();
  stage.execution().watch({});
  return recorder.take();
}

const StepRecord& recordOf(const std::vector<StepRecord>& records, const char* pass, const char* resource) {
  const auto found = std::ranges::find_if(
      records, [&](const StepRecord& r) { return r.pass == pass && r.resource == resource; });
  REQUIRE_MESSAGE(found != records.end(), pass << " " << resource);
  return *found;
}

}  // namespace

TEST_CASE("each step has a record of what it wrote, the same in every frame") {
  const CleanScope clean;
  Stage stage(kRecorded, 16, 16);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  StepRecorder recorder;
  const auto records = recordFrame(stage, recorder);
  CHECK(records.size() == 14);  // 6 of the chain, 2 of `numbers`, one of each of the 6 others
  CHECK(recordOf(records, "chain[0,0]", "chain").hash != recordOf(records, "chain[1,0]", "chain").hash);
  // `shown` and `shown_ids` share storage, and are two pictures.
  CHECK(recordOf(records, "show", "shown").hash != recordOf(records, "show_ids", "shown_ids").hash);
  const auto again = recordFrame(stage, recorder);
  REQUIRE(again.size() == records.size());
  for (std::size_t i = 0; i < records.size(); ++i) CHECK(again[i].hash == records[i].hash);

  // One texel of `first` is NaN and one infinite.
  CHECK(recordOf(records, "one", "first").broken == doctest::Approx(2.0 / 32));
  CHECK(recordOf(records, "deep", "deep").broken == 0);
}

TEST_CASE("a pass that did not run has no record, and one that keeps its results has") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/slices.json", 8, 8);
  stage.settings.sets = {{"m", "2"}};
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  StepRecorder recorder;
  const auto passesAt = [&](std::uint32_t number) {
    stage.execution().watch({.after = [&](std::uint32_t step) { recorder.look(stage.execution(), step); }});
    FrameInput input = headlessFrame(stage.world, number, 60);
    input.headless = false;
    stage.run(input);
    stage.execution().watch({});
    std::string passes, last;
    for (const StepRecord& record : recorder.take())
      if (std::exchange(last, record.pass) != record.pass) passes += record.pass + " ";
    return passes;
  };
  // `map` takes two frames, then its group is published. Until then `total` and `after` wait.
  CHECK(passesAt(0) == "field show ");
  CHECK(passesAt(1) == "map show ");
  CHECK(passesAt(2) == "map show ");
  CHECK(passesAt(3) == "field map total after show ");
  CHECK(passesAt(4) == "field map total after show ");  // all but `show` ran earlier
  CHECK_FALSE(stage.ran("after"));
}

TEST_CASE("a hash does not depend on what a pass leaves out of a buffer") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/tail.json", 8, 8);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  StepRecorder recorder;
  const auto hashOver = [&](PoisonPattern pattern, bool prepared) {
    stage.execution().watch({.before =
                                 [&](std::uint32_t step) {
                                   fillWithPoison(stage.execution(), step, pattern);
                                   if (prepared) recorder.prepare(stage.execution(), step);
                                 },
                             .after = [&](std::uint32_t step) { recorder.look(stage.execution(), step); }});
    stage.run();
    stage.execution().watch({});
    return recordOf(recorder.take(), "fill", "table").hash;
  };
  CHECK(hashOver(PoisonPattern::nan, false) != hashOver(PoisonPattern::large, false));
  CHECK(hashOver(PoisonPattern::nan, true) == hashOver(PoisonPattern::large, true));
}

TEST_CASE("poison is what a pass finds, and no pass of a sound graph shows it") {
  const CleanScope clean;
  for (const char* graph : {kRecorded, "graphs/glow.json"}) {
    Stage stage(graph, 32, 18);
    REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
    stage.run();
    const auto expected = gl::readFloats(stage.execution().presented());
    for (const PoisonPattern pattern : {PoisonPattern::nan, PoisonPattern::large}) {
      const graph::Plan& plan = stage.execution().plan();
      std::size_t poisoned = 0;
      stage.execution().watch({.before = [&](std::uint32_t step) {
        fillWithPoison(stage.execution(), step, pattern);
        for (std::uint32_t r = 0; r < plan.graph->resources.size(); ++r) {
          const graph::FlatResource& desc = plan.graph->resources[r];
          const bool floats = desc.format == graph::Format::rgba32f || desc.format == graph::Format::rgba16f;
          if (plan.firstStep[r] != step || plan.persistent[r] || graph::isImported(desc) || !floats) continue;
          const float found = gl::readFloats(stage.execution().texture(r))[0];
          CHECK((pattern == PoisonPattern::nan ? std::isnan(found) : found == 30000));
          ++poisoned;
        }
      }});
      stage.run();
      stage.execution().watch({});
      CHECK(poisoned == (graph == kRecorded ? 4 : 1));
      const auto found = gl::readFloats(stage.execution().presented());
      REQUIRE(found.size() == expected.size());
      for (std::size_t i = 0; i < found.size(); ++i)
        CHECK((found[i] == expected[i] || (std::isnan(found[i]) && std::isnan(expected[i]))));
    }
  }
}

}  // namespace inspection_step_watches_test
