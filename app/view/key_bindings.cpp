#include "app/view/key_bindings.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

namespace weft::app {

namespace {

// clang-format off
constexpr WithKey kAlone = WithKey::nothing;
constexpr KeyBinding kBindings[] = {
    {0, kAlone, "", "left drag", "turn around the scene"},
    {0, kAlone, "", "Ctrl left drag", "the same, where the graph reads the mouse"},
    {0, kAlone, "", "right drag", "slide sideways"},
    {0, kAlone, "", "wheel", "nearer and farther; flying: faster and slower"},
    {'F', kAlone, "fly", "F", "fly, with the mouse captured; again: back to turning"},
    {0, kAlone, "", "W A S D", "flying: forward, left, back, right (places of a US keyboard)"},
    {0, kAlone, "", "E Q", "flying: up, down"},
    {0, kAlone, "", "Shift", "flying: four times as fast"},
    {'B', kAlone, "head_bob", "B", "flying: head-bob on and off"},
    {'R', kAlone, "reset_camera", "R", "the first camera again"},
    {'1', kAlone, "camera_1", "1 ... 9", "cameras of the scene: the one it began with, the others in the order of its file"},
    {'C', kAlone, "copy_command", "C", "copy and print the command that renders what is seen"},
    {'K', kAlone, "save_camera", "K", "keep the view as a camera of the scene file (Ctrl Z takes it back)"},
    {GLFW_KEY_PAGE_DOWN, kAlone, "next_environment", "PgDn PgUp", "next and previous environment of the folder"},
    {GLFW_KEY_PAGE_UP, kAlone, "previous_environment", "", ""},
    {GLFW_KEY_SPACE, kAlone, "panels", "Space", "show or hide the panels"},
    {GLFW_KEY_F1, kAlone, "help", "F1", "show or hide this help"},
    {'Z', WithKey::control, "undo", "Ctrl Z", "take back the last change"},
    {'Y', WithKey::control, "redo", "Ctrl Y", "make it again"},
    {GLFW_KEY_F8, kAlone, "write_back", "F8", "show what would be written into which file; again: write it"},
    {'T', kAlone, "pause", "T", "time stands still, or goes on"},
    {'.', kAlone, "step", ".", "one frame of 1/60 s, and time stands still"},
    {GLFW_KEY_HOME, kAlone, "reset_time", "Home", "time begins anew"},
    {'P', kAlone, "profile", "P", "measure each pass (slower on software)"},
    {'N', kAlone, "find_nan", "N", "name the first pass that writes NaN or an infinity, and select it"},
    {'X', kAlone, "trace_pixel", "X", "show what each pass leaves at the pixel under the mouse"},
    {'O', kAlone, "edit_pass", "O", "open the selected pass in the editor, where its stanza is"},
    {'O', WithKey::shift, "edit_shader", "Shift O", "open its shader there"},
    {'M', kAlone, "compare", "M", "keep the picture and compare with it along a line; again: let it go"},
    {'V', kAlone, "vsync", "V", "wait for the screen's refresh, or not"},
    {'I', kAlone, "idle", "I", "idle mode: draw only when something changed"},
    {'-', kAlone, "render_scale_down", "- =", "render with fewer or more pixels than the picture has"},
    {'=', kAlone, "render_scale_up", "", ""},
    {'+', kAlone, "render_scale_up", "", ""},
    {GLFW_KEY_F10, kAlone, "record", "F10", "start or stop recording every frame, at a fixed step"},
    {GLFW_KEY_F11, kAlone, "full_screen", "F11", "the whole screen; again: a window"},
    {GLFW_KEY_F12, kAlone, "screenshot", "F12", "save the picture as weft_<frame>.png"},
    {GLFW_KEY_F12, WithKey::shift, "screenshot_exr", "Shift F12", "save its values as weft_<frame>.exr"},
    {GLFW_KEY_ESCAPE, kAlone, "close", "Esc", "close what is on top: a list, the help, a question, a flight, then the window"},
    {GLFW_KEY_ESCAPE, WithKey::shift, "close_at_once", "Shift Esc", "close the window without writing anything"},
};
// clang-format on

}  // namespace

std::span<const KeyBinding> keyBindings() {
  return kBindings;
}

std::string actionOf(int key, WithKey with) {
  if (key >= '1' && key <= '9' && with != WithKey::control) return fmt::format("camera_{}", key - '0');
  std::string alone;
  for (const KeyBinding& binding : kBindings) {
    if (binding.key != key || !*binding.action) continue;
    if (binding.with == with) return binding.action;
    if (binding.with == kAlone && with == WithKey::shift) alone = binding.action;
  }
  return alone;
}

}  // namespace weft::app
