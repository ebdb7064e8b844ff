// The import `mouse` in a running graph. tests/app/commands/mouse.py has the option, tests/app/view/mouse.py the window.
#include <vector>

#include "tests/runtime/stage.h"

namespace mouse_test {

using namespace weft;
using namespace weft::runtime;
using namespace weft::runtime::test;

namespace {

// position and dragged, pressed, down and clicked.
std::vector<float> stateIn(Stage& stage) {
  const std::vector<float> texels = stage.read("state");
  return {texels.begin(), texels.begin() + 8};
}

}  // namespace

TEST_CASE("a shader sees the mouse of the frame; without one all is zero") {
  context();
  const CleanScope scope;
  Stage stage("tests/imports/graphs/mouse.json", 4, 2);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(0);
  CHECK(stateIn(stage) == std::vector<float>(8, 0));
  FrameInput input = headlessFrame(stage.world, 1, 60);
  input.pointer = {.position = {1, 2}, .dragged = {3, 4}, .pressed = {5.5, 6.25}, .down = true};
  stage.run(input);
  CHECK(stateIn(stage) == std::vector<float>{1, 2, 3, 4, 5.5, 6.25, 1, 0});
  input.pointer.clicked = true;
  stage.run(input);
  CHECK(stateIn(stage) == std::vector<float>{1, 2, 3, 4, 5.5, 6.25, 1, 1});
}

TEST_CASE("what is made of the mouse is made anew when that changes, and only then") {
  context();
  const CleanScope scope;
  Stage stage("tests/imports/graphs/mouse.json", 4, 2);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  FrameInput input = headlessFrame(stage.world, 0, 60);
  const auto runs = [&] {
    stage.run(input);
    return stage.ran("state");
  };
  CHECK(runs());
  CHECK_FALSE(runs());
  for (const imports::Pointer& pointer :
       {imports::Pointer{.position = {1, 0}}, imports::Pointer{.dragged = {1, 0}},
        imports::Pointer{.pressed = {1, 0}}, imports::Pointer{.down = true},
        imports::Pointer{.clicked = true}, imports::Pointer{}}) {
    input.pointer = pointer;
    CHECK(runs());
    CHECK_FALSE(runs());
  }
}

TEST_CASE(
    "a held button goes down in frame 0 of a headless run, and what is kept of it depends on that frame") {
  context();
  const CleanScope scope;
  Stage stage("tests/imports/graphs/mouse.json", 4, 2);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  const imports::Pointer held{.position = {1, 1}, .dragged = {1, 1}, .pressed = {1, 1}, .down = true};
  CHECK(headlessFrame(stage.world, 0, 60, held).pointer.clicked);
  CHECK_FALSE(headlessFrame(stage.world, 1, 60, held).pointer.clicked);
  CHECK_FALSE(headlessFrame(stage.world, 0, 60, {.position = {1, 1}}).pointer.clicked);
  CHECK(stage.execution().remembers(stage.world));
}

TEST_CASE("a graph follows the mouse when a pass that is not culled reads it") {
  context();
  const CleanScope scope;
  Stage stage("tests/imports/graphs/mouse.json", 4, 2);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  CHECK(stage.execution().followsPointer());
  Stage glow("graphs/glow.json", 4, 2);
  REQUIRE_MESSAGE(glow.load(), glow.diagnostics.text());
  CHECK_FALSE(glow.execution().followsPointer());
}

}  // namespace mouse_test
