// What keys and the mouse do in the viewer: one table. The window's callbacks turn a key into the name of an action,
// whoever does something registers it under that name; the help and the table in docs/viewer.md are made of the same rows.
#pragma once

#include <span>
#include <string>

namespace weft::app {

struct KeyBinding {
  int key;             // GLFW_KEY_…
  bool shift;          // with the shift key; without, the key does so in any case where it has no other row
  const char* action;  // name; empty: only listed
  const char* keys;    // as a person reads it; empty: listed by the row before
  const char* does;
};

std::span<const KeyBinding> keyBindings();

// The action of a key that was pressed, empty when it has none.
std::string actionOf(int key, bool shift);

}  // namespace weft::app
