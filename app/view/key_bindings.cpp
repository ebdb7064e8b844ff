#include "app/view/key_bindings.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

namespace weft::app {

namespace {

// clang-format off
constexpr KeyBinding kBindings[] = {
    {0, false, "", "left drag", "turn around the scene"},
    {0, false, "", "Ctrl left drag", "the same, where the graph reads the mouse"},
    {0, false, "", "right drag", "slide sideways"},
    {0, false, "", "wheel", "nearer and farther; flying: faster and slower"},
    {GLFW_KEY_F, false, "fly", "F", "fly, with the mouse captured; again: back to turning"},
    {0, false, "", "W A S D", "flying: forward, left, back, right"},
    {0, false, "", "E Q", "flying: up, down"},
    {0, false, "", "Shift", "flying: four times as fast"},
    {GLFW_KEY_B, false, "head_bob", "B", "flying: head-bob on and off"},
    {GLFW_KEY_R, false, "reset_camera", "R", "the scene's camera again"},
    {GLFW_KEY_1, false, "camera_1", "1 ... 9", "cameras of the scene, in the order of its file"},
    {GLFW_KEY_PAGE_DOWN, false, "next_environment", "PgDn PgUp", "next and previous environment of the folder"},
    {GLFW_KEY_PAGE_UP, false, "previous_environment", "", ""},
    {GLFW_KEY_SPACE, false, "panels", "Space", "show or hide the panels"},
    {GLFW_KEY_F1, false, "help", "F1", "show or hide this help"},
    {GLFW_KEY_F2, false, "panel_parameters", "F2 F3", "parameters; passes"},
    {GLFW_KEY_F3, false, "panel_passes", "", ""},
    {GLFW_KEY_F4, false, "panel_inspector", "F4", "texture inspector"},
    {GLFW_KEY_F5, false, "panel_profiler", "F5", "frame profiler"},
    {GLFW_KEY_F6, false, "panel_storage", "F6", "storage over the steps of the frame"},
    {GLFW_KEY_F7, false, "panel_histogram", "F7", "histogram of the picture"},
    {GLFW_KEY_F8, false, "write_back", "F8", "write what was changed here into the files"},
    {GLFW_KEY_P, false, "profile", "P", "measure each pass (slower on software)"},
    {GLFW_KEY_V, false, "vsync", "V", "wait for the screen's refresh, or not"},
    {GLFW_KEY_I, false, "idle", "I", "idle mode: draw only when something changed"},
    {GLFW_KEY_MINUS, false, "render_scale_down", "- =", "render with fewer or more pixels than the window has"},
    {GLFW_KEY_EQUAL, false, "render_scale_up", "", ""},
    {GLFW_KEY_F10, false, "record", "F10", "start or stop recording every frame, at a fixed step"},
    {GLFW_KEY_F12, false, "screenshot", "F12", "save the picture as weft_<frame>.png"},
    {GLFW_KEY_F12, true, "screenshot_exr", "Shift F12", "save its values as weft_<frame>.exr"},
    {GLFW_KEY_ESCAPE, false, "close", "Esc", "flying: let go of the mouse; else close"},
};
// clang-format on

}  // namespace

std::span<const KeyBinding> keyBindings() {
  return kBindings;
}

std::string actionOf(int key, bool shift) {
  if (key >= GLFW_KEY_1 && key <= GLFW_KEY_9) return fmt::format("camera_{}", key - GLFW_KEY_0);
  std::string without;
  for (const KeyBinding& binding : kBindings) {
    if (binding.key != key) continue;
    if (binding.shift == shift) return binding.action;
    if (!binding.shift) without = binding.action;
  }
  return without;
}

}  // namespace weft::app
