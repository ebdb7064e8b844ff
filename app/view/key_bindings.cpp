#include "app/view/key_bindings.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace weft::app {

namespace {

constexpr KeyBinding kBindings[] = {
    {GLFW_KEY_UNKNOWN, "", "left drag", "turn around the scene"},
    {GLFW_KEY_UNKNOWN, "", "wheel", "nearer and farther"},
    {GLFW_KEY_R, "reset_camera", "R", "the scene's camera again"},
    {GLFW_KEY_PAGE_DOWN, "next_environment", "Page Down", "the next environment of the folder"},
    {GLFW_KEY_PAGE_UP, "previous_environment", "Page Up", "the previous environment of the folder"},
    {GLFW_KEY_SPACE, "panels", "Space", "show or hide the panels"},
    {GLFW_KEY_F1, "help", "F1", "show or hide this help"},
    {GLFW_KEY_P, "profile", "P", "measure each pass (slower on software)"},
    {GLFW_KEY_F12, "screenshot", "F12", "save the picture as weft_<frame>.png"},
    {GLFW_KEY_ESCAPE, "close", "Esc", "close"},
};

}  // namespace

std::span<const KeyBinding> keyBindings() {
  return kBindings;
}

std::string_view actionOf(int key) {
  for (const KeyBinding& binding : kBindings)
    if (binding.key == key && key != GLFW_KEY_UNKNOWN) return binding.action;
  return {};
}

std::string keyTable() {
  std::string text = "| input | does |\n|---|---|\n";
  for (const KeyBinding& binding : kBindings) {
    const bool key = binding.key != GLFW_KEY_UNKNOWN;
    text +=
        std::string("| ") + (key ? "`" : "") + binding.keys + (key ? "` | " : " | ") + binding.does + " |\n";
  }
  return text;
}

}  // namespace weft::app
