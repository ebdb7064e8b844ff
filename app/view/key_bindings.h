// What keys and the mouse do in the viewer: one table. The window's callbacks turn a key into the name of an
// action, whoever does something registers it under that name (app/view/actions.h); the help and the table in
// docs/viewer.md are made of the same rows. Does not: do anything, know GLFW's window.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace weft::app {

struct KeyBinding {
  int key;             // GLFW_KEY_…; GLFW_KEY_UNKNOWN: the mouse, in the table only to be listed
  const char* action;  // name; empty for the mouse
  const char* keys;    // as a person reads it
  const char* does;
};

std::span<const KeyBinding> keyBindings();

// The action of a key, empty when it has none.
std::string_view actionOf(int key);

// All rows as a Markdown table, as docs/viewer.md has it.
std::string keyTable();

}  // namespace weft::app
