// What keys and the mouse do in the viewer: one table, which the key callback acts on and the help overlay prints.
#pragma once

#include <GLFW/glfw3.h>

namespace weft::app {

enum class Action { none, help, screenshot, close, toggleUi, resetCamera, toggleProfile };

struct KeyBinding {
  int key;  // GLFW_KEY_…; GLFW_KEY_UNKNOWN for the mouse
  Action action;
  const char* name;
  const char* does;
};

inline constexpr KeyBinding kKeyBindings[] = {
    {GLFW_KEY_F1, Action::help, "F1", "show or hide this help"},
    {GLFW_KEY_SPACE, Action::toggleUi, "Space", "show or hide the panels"},
    {GLFW_KEY_R, Action::resetCamera, "R", "the scene's camera again"},
    {GLFW_KEY_P, Action::toggleProfile, "P", "measure each pass (slower on software)"},
    {GLFW_KEY_F12, Action::screenshot, "F12", "save the picture as weft_<frame>.png"},
    {GLFW_KEY_ESCAPE, Action::close, "Esc", "close"},
    {GLFW_KEY_UNKNOWN, Action::none, "left drag", "turn around the scene"},
    {GLFW_KEY_UNKNOWN, Action::none, "wheel", "nearer and farther"},
};

inline Action actionOf(int key) {
  for (const KeyBinding& binding : kKeyBindings)
    if (binding.key == key && key != GLFW_KEY_UNKNOWN) return binding.action;
  return Action::none;
}

}  // namespace weft::app
