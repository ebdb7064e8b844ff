#include "app/view/key_bindings.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace weft::app {

namespace {

using How = KeyBinding::How;

// clang-format off
constexpr KeyBinding kBindings[] = {
    {How::mouse, 0, false, "", "left drag", "turn around the scene"},
    {How::mouse, 0, false, "", "Ctrl left drag", "the same, where the graph reads the mouse"},
    {How::mouse, 0, false, "", "right drag", "slide sideways"},
    {How::mouse, 0, false, "", "wheel", "nearer and farther; flying: faster and slower"},
    {How::press, GLFW_KEY_F, false, "fly", "F", "fly, with the mouse captured; again: back to turning"},
    {How::held, GLFW_KEY_W, false, "forward", "W A S D", "flying: forward, left, back, right"},
    {How::held, GLFW_KEY_A, false, "left", "", ""},
    {How::held, GLFW_KEY_S, false, "back", "", ""},
    {How::held, GLFW_KEY_D, false, "right", "", ""},
    {How::held, GLFW_KEY_E, false, "up", "E Q", "flying: up, down"},
    {How::held, GLFW_KEY_Q, false, "down", "", ""},
    {How::held, GLFW_KEY_LEFT_SHIFT, false, "fast", "Shift", "flying: four times as fast"},
    {How::press, GLFW_KEY_B, false, "head_bob", "B", "flying: head-bob on and off"},
    {How::press, GLFW_KEY_R, false, "reset_camera", "R", "the scene's camera again"},
    {How::press, GLFW_KEY_1, false, "camera_1", "1 ... 9", "cameras of the scene, in the order of its file"},
    {How::press, GLFW_KEY_2, false, "camera_2", "", ""},
    {How::press, GLFW_KEY_3, false, "camera_3", "", ""},
    {How::press, GLFW_KEY_4, false, "camera_4", "", ""},
    {How::press, GLFW_KEY_5, false, "camera_5", "", ""},
    {How::press, GLFW_KEY_6, false, "camera_6", "", ""},
    {How::press, GLFW_KEY_7, false, "camera_7", "", ""},
    {How::press, GLFW_KEY_8, false, "camera_8", "", ""},
    {How::press, GLFW_KEY_9, false, "camera_9", "", ""},
    {How::press, GLFW_KEY_PAGE_DOWN, false, "next_environment", "PgDn PgUp", "next and previous environment of the folder"},
    {How::press, GLFW_KEY_PAGE_UP, false, "previous_environment", "", ""},
    {How::press, GLFW_KEY_SPACE, false, "panels", "Space", "show or hide the panels"},
    {How::press, GLFW_KEY_F1, false, "help", "F1", "show or hide this help"},
    {How::press, GLFW_KEY_F2, false, "panel_parameters", "F2 F3", "parameters; passes"},
    {How::press, GLFW_KEY_F3, false, "panel_passes", "", ""},
    {How::press, GLFW_KEY_F4, false, "panel_inspector", "F4", "texture inspector"},
    {How::press, GLFW_KEY_F5, false, "panel_profiler", "F5", "frame profiler"},
    {How::press, GLFW_KEY_F6, false, "panel_storage", "F6", "storage over the steps of the frame"},
    {How::press, GLFW_KEY_F7, false, "panel_histogram", "F7", "histogram of the picture"},
    {How::press, GLFW_KEY_F8, false, "write_back", "F8", "write what was changed here into the files"},
    {How::press, GLFW_KEY_P, false, "profile", "P", "measure each pass (slower on software)"},
    {How::press, GLFW_KEY_V, false, "vsync", "V", "wait for the screen's refresh, or not"},
    {How::press, GLFW_KEY_I, false, "idle", "I", "idle mode: draw only when something changed"},
    {How::press, GLFW_KEY_MINUS, false, "render_scale_down", "- =", "render with fewer or more pixels than the window has"},
    {How::press, GLFW_KEY_EQUAL, false, "render_scale_up", "", ""},
    {How::press, GLFW_KEY_F10, false, "record", "F10", "start or stop recording every frame, at a fixed step"},
    {How::press, GLFW_KEY_F12, false, "screenshot", "F12", "save the picture as weft_<frame>.png"},
    {How::press, GLFW_KEY_F12, true, "screenshot_exr", "Shift F12", "save its values as weft_<frame>.exr"},
    {How::press, GLFW_KEY_ESCAPE, false, "close", "Esc", "flying: let go of the mouse; else close"},
};
// clang-format on

}  // namespace

std::span<const KeyBinding> keyBindings() {
  return kBindings;
}

std::string_view actionOf(int key, bool shift) {
  std::string_view without;
  for (const KeyBinding& binding : kBindings) {
    if (binding.how != How::press || binding.key != key) continue;
    if (binding.shift == shift) return binding.action;
    if (!binding.shift) without = binding.action;
  }
  return without;
}

}  // namespace weft::app
