// History on the GPU: x@-n is the n-th previous publication, `first` and `reset` hold, age(x) counts.
#include <cmath>

#include "tests/runtime/stage.h"

namespace frame_history_test {

using namespace weft;
using namespace weft::runtime::test;

namespace {
constexpr const char* kScene = "scenes/empty.json";
}

TEST_CASE("history: a sum over frames counts them") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/accumulate.json", 8, 8, kScene);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  for (std::uint32_t n = 1; n <= 7; ++n) {
    stage.run(n - 1);
    CHECK(stage.value() == static_cast<float>(n));
  }
}

TEST_CASE("history: it survives a new plan, and a reset gives the first value again") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/accumulate.json", 8, 8, kScene);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  for (std::uint32_t frame = 0; frame < 3; ++frame) stage.run(frame);
  stage.settings.sets = {{"amount", "10"}};
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(3);
  CHECK(stage.value() == 13);
  runtime::FrameInput cut = runtime::headlessFrame(stage.world, 4, 60);
  cut.cutGeneration = 1;
  stage.run(cut);
  CHECK(stage.value() == 10);
  cut.frame = 5;
  stage.run(cut);
  CHECK(stage.value() == 20);
  stage.settings.screenWidth = 16;  // the graph resets by size(screen_size)
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  cut.frame = 6;
  stage.run(cut);
  CHECK(stage.value() == 10);
}

TEST_CASE("history: a pass before the writer reads the frame before, as one after it does") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/obsolete.json", 8, 8, kScene);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  float step = 0;  // step = 2 * step of the frame before + 1
  for (std::uint32_t frame = 0; frame < 5; ++frame) {
    step = 2 * step + 1;
    stage.run(frame);
    CHECK(stage.value() == 10 * step + 0.5f);
  }
}

TEST_CASE("history: two frames back") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/fibonacci.json", 8, 8, kScene);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  // x = x@-1 + x@-2 from first = 1
  for (std::uint32_t frame = 0; const float expected : {2.0f, 3.0f, 5.0f, 8.0f, 13.0f, 21.0f}) {
    stage.run(frame++);
    CHECK(stage.value() == expected);
  }
}

TEST_CASE("history: a first value that is a texture, an image or a buffer is what the first frames read") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/first.json", 8, 8, kScene);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  struct Expected {
    float sum, growing, copied, count;
  };
  std::uint32_t frame = 0;
  const auto check = [&](runtime::FrameInput input, const Expected& expected) {
    input.frame = frame++;
    stage.run(input);
    CHECK(stage.value() == expected.sum);
    CHECK(stage.read("growing")[0] == expected.growing);
    CHECK(stage.read("copied")[0] == expected.copied);
    stage.execution().readBack().finish();
    CHECK(stage.execution().readBack().find("count")->number(0) == expected.count);
  };
  runtime::FrameInput input = runtime::headlessFrame(stage.world, 0, 60);
  check(input, {6, 10, 4, 8});
  const std::vector<float> picture = stage.read("plain");
  CHECK(picture[3] == 1);
  for (std::size_t i = 0; i < 4; ++i) CHECK(stage.read("kept")[i] == picture[i] + 1);
  check(input, {7, 15, 5, 9});  // growing: 10 + 5
  for (std::size_t i = 0; i < 4; ++i) CHECK(stage.read("kept")[i] == picture[i] + 2);
  check(input, {8, 25, 6, 10});
  // A reset begins with what the texture holds by then.
  stage.settings.sets = {{"start", "20"}};
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  check(input, {9, 40, 7, 11});
  input.cutGeneration = 1;
  check(input, {21, 40, 4, 8});
  check(input, {22, 60, 5, 9});
}

TEST_CASE("history: age counts seconds since the publication, and is infinite from before headless frame 0") {
  const CleanScope clean;
  Stage headless("tests/runtime/graphs/age.json", 8, 8, kScene);
  REQUIRE_MESSAGE(headless.load(), headless.diagnostics.text());
  headless.run(0);
  CHECK(headless.value() == 1);
  headless.run(5);
  CHECK(headless.value() == 1);

  Stage live("tests/runtime/graphs/age.json", 8, 8, kScene);
  REQUIRE_MESSAGE(live.load(), live.diagnostics.text());
  for (const double time : {10.0, 10.5, 11.0, 12.0, 13.0}) {
    runtime::FrameInput input = runtime::headlessFrame(live.world, 0, 60);
    input.headless = false;
    input.time = time;
    live.run(input);
    CHECK(live.value() == doctest::Approx(std::min((time - 10.0) / 2.0, 1.0)));  // min(age(pulse) / 2, 1)
  }
}

}  // namespace frame_history_test
