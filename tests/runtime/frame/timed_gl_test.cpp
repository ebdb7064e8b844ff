// Passes that run in some frames only, because age() decides: what they modify is as it was at other times.
#include "tests/runtime/frame_allocations.h"
#include "tests/runtime/stage.h"

using namespace weft;
using namespace weft::runtime;
using namespace weft::runtime::test;

namespace {

FrameInput at(Stage& stage, double time, bool headless = false) {
  FrameInput input = headlessFrame(stage.world, 0, 60);
  input.headless = headless;
  input.time = time;
  return input;
}

}  // namespace

TEST_CASE(
    "timed: a pass runs while its condition holds, also one without a shader, and again after the next "
    "publication") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/timed.json", 8, 8);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  const auto frame = [&](double time, float value, bool runs) {
    CAPTURE(time);
    stage.run(at(stage, time));
    CHECK(stage.value() == value);
    CHECK(stage.ran("take") == runs);
    CHECK(stage.ran("add") == runs);
    CHECK(stage.ran("start"));
  };
  for (int round = 0; round < 2; ++round) {
    const double from = 10 * round;
    const float beat = round == 0 ? 1 : 7;
    frame(from, 100 + beat, true);  // published in this frame
    frame(from + 1, 100 + beat, true);
    frame(from + 1.9, 100 + beat, true);
    frame(from + 2.1, 100, false);
    frame(from + 5, 100, false);
    REQUIRE(stage.renderer().setParameter("beat", graph::Value::number(7)));
  }
}

TEST_CASE("timed: both ways once prepared, no frame allocates anything, and nothing is compiled") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/timed.json", 8, 8);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  const auto compiled = stage.renderer().device().programs.stats().compilations;
  for (const double time : {0.0, 1.0, 3.0, 4.0}) stage.run(at(stage, time));
  std::size_t allocations = 0;
  for (int i = 0; i < 8; ++i) {
    if (i % 4 == 0 && !stage.renderer().setParameter("beat", graph::Value::number(2 + i))) FAIL("beat");
    const FrameInput input = at(stage, 10 + i);
    startCountingAllocations();
    stage.renderer().frame(stage.world, input, stage.diagnostics);
    allocations += stopCountingAllocations();
    CHECK(stage.ran("add") == (i % 4 < 2));
  }
  CHECK(stage.diagnostics.empty());
  CHECK(allocations == 0);
  CHECK(stage.renderer().device().programs.stats().compilations == compiled);
}

TEST_CASE(
    "timed: what a timed pass reads the earlier publication of waits with the next one, also for a blit") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/timed_hold.json", 8, 8);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  const auto frame = [&](double time, float value, bool publishes) {
    CAPTURE(time);
    stage.run(at(stage, time));
    CHECK(stage.value() == value);
    CHECK(stage.ran("pulse") == publishes);
  };
  frame(0, 100, true);
  REQUIRE(stage.renderer().setParameter("beat", graph::Value::number(7)));
  frame(1, 100, false);
  frame(1.9, 100, false);
  frame(2.1, 101, true);  // 7 is published, 1 was before
  frame(3, 101, false);
  frame(4.2, 100, false);
}

TEST_CASE("timed: headless, everything was published long ago") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/timed.json", 8, 8);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(0);
  CHECK(stage.value() == 100);
  CHECK_FALSE(stage.ran("add"));
}

TEST_CASE(
    "timed: a shader that does not compile is reported when the graph is loaded, not when its time comes") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/timed_bad.json", 8, 8);
  CHECK_FALSE(stage.load());
  CHECK(stage.diagnostics.contains(base::Code::shaderDoesNotCompile));
}
