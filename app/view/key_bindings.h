// What keys and the mouse do in the viewer: one table, of which callbacks, help and docs/viewer.md are made.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace weft::app {

enum class WithKey : std::uint8_t { nothing, shift, control };

struct KeyBinding {
  int key;             // its letter on the user's keyboard, upper case, or GLFW_KEY_…
  WithKey with;        // without anything, the key does so with Shift, too, where that has no other row
  const char* action;  // name; empty: only listed
  const char* keys;    // as a person reads it; empty: listed by the row before
  const char* does;
};

std::span<const KeyBinding> keyBindings();

// The action of a key that was pressed, empty when it has none.
std::string actionOf(int key, WithKey with);

}  // namespace weft::app
