// Outputs: what arrives is what the GPU held at the end of the frame that is named, soon, through changes of
// the plan, and without allocating.
#include <algorithm>
#include <cstring>

#include "tests/runtime/frame_allocations.h"
#include "tests/runtime/stage.h"

namespace frame_read_back_test {

using namespace weft;
using namespace weft::runtime::test;

namespace {

constexpr const char* kGraph = "tests/runtime/graphs/outputs.json";
constexpr const char* kScene = "scenes/empty.json";

std::vector<double> numbersOf(Stage& stage, std::string_view name) {
  const runtime::Output* output = stage.execution().readBack().find(name);
  REQUIRE(output);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < output->count(); ++i) numbers.push_back(output->number(i));
  return numbers;
}

std::vector<std::string> namesOf(Stage& stage) {
  std::vector<std::string> names;
  for (const runtime::Output& output : stage.execution().readBack().outputs()) names.push_back(output.name);
  return names;
}

void set(Stage& stage, std::vector<weft::graph::Setting> sets) {
  stage.settings.sets = std::move(sets);
  REQUIRE_MESSAGE(stage.apply(), stage.diagnostics.text());
}

using Numbers = std::vector<double>;

}  // namespace

TEST_CASE("outputs: values, their kinds, and what is not there") {
  const CleanScope clean;
  Stage stage(kGraph, 4, 2, kScene);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  CHECK(namesOf(stage) == std::vector<std::string>{"sum", "counts", "field", "shown", "before"});
  CHECK_FALSE(stage.execution().readBack().find("sum")->arrived);
  CHECK(stage.execution().readBack().find("nothing") == nullptr);
  for (std::uint32_t frame = 0; frame < 3; ++frame) stage.run(frame);
  stage.execution().readBack().finish();
  CHECK(numbersOf(stage, "sum") == Numbers{3, 6, 1, 0});
  CHECK(numbersOf(stage, "before") == Numbers{2, 4, 1, 0});
  CHECK(stage.execution().readBack().find("counts")->kind == runtime::NumberKind::unsigned_integer);
  CHECK(numbersOf(stage, "counts") == Numbers{3, 4, 5, 6});
  CHECK(stage.execution().readBack().find("field")->kind == runtime::NumberKind::signed_integer);
  CHECK(numbersOf(stage, "field") == Numbers{0, 1, 2, -10, -9, -8});
  CHECK(stage.execution().readBack().find("shown")->width == 4);
  CHECK(numbersOf(stage, "shown") == Numbers(4 * 2 * 4, 1.0));
  for (const runtime::Output& output : stage.execution().readBack().outputs()) {
    CHECK(output.arrived);
    CHECK(output.frame == 2);
  }
  std::uint64_t offset = 0;
  const runtime::BufferRef sum = stage.buffer("sum", offset);
  const std::vector<std::byte> now = gl::readBuffer(sum.id, offset, sum.bytes);
  CHECK(std::ranges::equal(now, stage.execution().readBack().find("sum")->bytes));
}

TEST_CASE("outputs: each is of the frame it says, and one frame behind when the GPU is done") {
  const CleanScope clean;
  Stage stage(kGraph, 4, 2, kScene);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  std::uint32_t before = 0;
  for (std::uint32_t frame = 0; frame < 40; ++frame) {
    if (frame >= 20) glFinish();
    stage.run(frame);
    const runtime::Output& sum = *stage.execution().readBack().find("sum");
    if (!sum.arrived) continue;
    CHECK(sum.number(0) == sum.frame + 1.0);
    CHECK(stage.execution().readBack().find("counts")->number(0) == sum.frame + 1.0);
    CHECK(sum.frame < frame);
    CHECK(sum.frame >= before);
    before = sum.frame;
    if (frame >= 20) CHECK(sum.frame == frame - 1);
  }
  glFinish();
  stage.execution().readBack().collect();
  CHECK(stage.execution().readBack().find("sum")->frame == 39);
}

TEST_CASE("outputs: they go through new plans and sizes, and come and go with their passes") {
  const CleanScope clean;
  Stage stage(kGraph, 4, 2, kScene);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  for (std::uint32_t frame = 0; frame < 3; ++frame) stage.run(frame);
  set(stage, {{"amount", "7"}});  // the same outputs: what is under way arrives
  stage.execution().readBack().finish();
  CHECK(stage.execution().readBack().find("sum")->frame == 2);
  CHECK(numbersOf(stage, "sum") == Numbers{3, 6, 1, 0});
  stage.run(3);
  stage.execution().readBack().finish();
  CHECK(numbersOf(stage, "sum") == Numbers{4, 8, 7, 0});
  set(stage, {{"whole", "false"}});  // one fewer: what had arrived stays
  CHECK(stage.execution().readBack().find("field") == nullptr);
  CHECK(stage.execution().readBack().find("sum")->arrived);
  CHECK(stage.execution().readBack().find("sum")->frame == 3);
  stage.run(4);
  stage.execution().readBack().finish();
  CHECK(numbersOf(stage, "sum") == Numbers{5, 10, 1, 0});
  stage.settings.screenWidth = 8;
  set(stage, {});
  CHECK(stage.execution().readBack().find("sum")->frame == 4);
  CHECK_FALSE(stage.execution().readBack().find("shown")->arrived);  // of another shape
  CHECK_FALSE(stage.execution().readBack().find("field")->arrived);
  stage.run(5);
  stage.execution().readBack().finish();
  CHECK(numbersOf(stage, "shown") == Numbers(8 * 2 * 4, 1.0));
  CHECK(numbersOf(stage, "field") == Numbers{0, 1, 2, -10, -9, -8});
  CHECK(stage.execution().readBack().find("field")->frame == 5);
}

TEST_CASE("outputs: a frame allocates nothing for them") {
  const CleanScope clean;
  Stage stage(kGraph, 4, 2, kScene);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  for (std::uint32_t frame = 0; frame < 6; ++frame) stage.run(frame);
  text::Diagnostics diagnostics;
  std::size_t allocations = 0;
  for (std::uint32_t frame = 6; frame < 16; ++frame) {
    const runtime::FrameInput input = runtime::headlessFrame(stage.world, frame, 60);
    startCountingAllocations();
    stage.renderer().frame(stage.world, input, diagnostics);
    allocations += stopCountingAllocations();
  }
  CHECK(allocations == 0);
  stage.execution().readBack().finish();
  CHECK(stage.execution().readBack().find("sum")->frame == 15);
}

TEST_CASE("outputs of post.json: the histogram without auto-exposure, and both with it") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/toggle.json", 64, 64, kScene);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  CHECK(namesOf(stage).empty());
  set(stage, {{"histogram", "true"}});
  CHECK(namesOf(stage) == std::vector<std::string>{"post.histogram"});
  stage.run(0);
  stage.execution().readBack().finish();
  const runtime::Output& histogram = *stage.execution().readBack().find("post.histogram");
  CHECK(histogram.kind == runtime::NumberKind::unsigned_integer);
  REQUIRE(histogram.count() == 256);
  double total = 0;
  for (std::size_t i = 0; i < 256; ++i) total += histogram.number(i);
  CHECK(total == 16 * 16 * 64);  // a texel in 4 x 4, as histogram.glsl counts them
  set(stage, {{"auto_exposure", "true"}});
  CHECK(namesOf(stage) == std::vector<std::string>{"post.exposure", "post.histogram"});
  stage.run(0);
  stage.execution().readBack().finish();
  std::uint64_t offset = 0;
  const runtime::BufferRef adapted = stage.buffer("post.adapted", offset);
  CHECK(std::ranges::equal(gl::readBuffer(adapted.id, offset, 16),
                           stage.execution().readBack().find("post.exposure")->bytes));
  CHECK(stage.execution().readBack().find("post.exposure")->number(0) > 0);
}

}  // namespace frame_read_back_test
