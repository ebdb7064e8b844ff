// Draws whose number of instances depends on age().
#include "tests/runtime/frame_allocations.h"
#include "tests/runtime/stage.h"

namespace frame_timed_test {

using namespace weft;
using namespace weft::runtime;
using namespace weft::runtime::test;

namespace {

FrameInput at(Stage& stage, double time) {
  FrameInput input = headlessFrame(stage.world, 0, 60);
  input.headless = false;
  input.time = time;
  return input;
}

}  // namespace

TEST_CASE(
    "timed: a draw has as many instances as the age says in each frame, and again after the next "
    "publication") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/timed.json", 8, 8);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  const auto compiled = stage.renderer().device().programs.stats().compilations;
  const auto frame = [&](double time, float value) {
    CAPTURE(time);
    stage.run(at(stage, time));
    CHECK(stage.value() == value);
  };
  for (int round = 0; round < 2; ++round) {
    const double from = 10 * round;
    const float beat = round == 0 ? 1 : 7;
    frame(from, 100 + 2 * beat);  // published in this frame
    frame(from + 0.9, 100 + 2 * beat);
    frame(from + 1.1, 100 + beat);
    frame(from + 2.1, 100);
    frame(from + 5, 100);
    REQUIRE(stage.renderer().setParameter("beat", graph::Value::number(7)));
  }
  std::size_t allocations = 0;
  for (int i = 0; i < 8; ++i) {
    if (i % 4 == 0 && !stage.renderer().setParameter("beat", graph::Value::number(2 + i))) FAIL("beat");
    const FrameInput input = at(stage, 20 + i);
    startCountingAllocations();
    stage.renderer().frame(stage.world, input, stage.diagnostics);
    allocations += stopCountingAllocations();
  }
  CHECK(stage.diagnostics.empty());
  CHECK(allocations == 0);
  CHECK(stage.renderer().device().programs.stats().compilations == compiled);
}

TEST_CASE("timed: headless, everything was published long ago, and any frame may be the first") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/timed.json", 8, 8);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(0);
  CHECK(stage.value() == 100);
  CHECK_FALSE(stage.execution().remembers(stage.world));
}

TEST_CASE("every(n): a pass sees the frames 0, n, 2n, and its picture stays until then") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/every.json", 1, 1);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  CHECK(stage.execution().remembers(stage.world));
  for (std::uint32_t frame = 0; frame < 8; ++frame) {
    CAPTURE(frame);
    stage.run(frame);
    const std::vector<float> both = stage.read("both");
    CHECK(both[0] == static_cast<float>(frame / 3 * 3));
    CHECK(both[1] == static_cast<float>(frame));
  }
}

}  // namespace frame_timed_test
