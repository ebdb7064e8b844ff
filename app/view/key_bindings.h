// What keys and the mouse do in the viewer: one table. The window's callbacks turn a key into the name of an action,
// whoever does something registers it under that name; the help and the table in docs/viewer.md are made of the same rows.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace weft::app {

struct KeyBinding {
  enum class How : std::uint8_t {
    press,  // runs the action
    held,   // asked for by name while it is down (WindowInput::held)
    mouse   // only listed
  };
  How how;
  int key;             // GLFW_KEY_…
  bool shift;          // press: with or without the shift key
  const char* action;  // name; empty for the mouse
  const char* keys;    // as a person reads it; empty: listed by the row before
  const char* does;
};

std::span<const KeyBinding> keyBindings();

// The action of a key that was pressed, empty when it has none.
std::string_view actionOf(int key, bool shift);

}  // namespace weft::app
