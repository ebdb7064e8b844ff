// What keys and the mouse do in the viewer: the table of keys.json, and over it that of a person's file. Input, help and docs/viewer.md are
// made of it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/text/json/dom.h"

namespace weft::app {

extern const char* const kKeys;  // keys.json

enum class WithKey : std::uint8_t { nothing, shift, control };

struct KeyBinding {
  int key = 0;  // its letter on the user's keyboard, upper case, or GLFW_KEY_…
  WithKey with =
      WithKey::nothing;  // without anything, the key does so with Shift, too, where that has no other row
  std::string keys;      // as a person reads it: "Shift F12"
  // "do" an action, "toggle" or "step" a parameter, "show" a pick, "open" a file; "": only listed.
  std::string verb, name;
  double by = 1;                    // of a step
  std::size_t as = 0, channel = 0;  // of what is shown: InspectColors, and 4: distance; InspectChannel
  std::optional<double> low, high;  // values shown black and white
  std::string help;                 // rows in a row with the same are one in the help
};

class KeyTable {
 public:
  KeyTable();  // that of keys.json

  // Lays the rows of a JSON object over those that are there; null takes one away. Rows that are wrong are reported and left out.
  void add(std::string_view json, text::FileName file, text::Diagnostics& diagnostics);

  std::span<const KeyBinding> rows() const { return rows_; }
  // Null when the key does nothing.
  const KeyBinding* find(int key, WithKey with) const;
  // The keys of a row and what they do.
  std::vector<std::pair<std::string, std::string>> help() const;

 private:
  void addRow(const text::JsonMember& member, text::Diagnostics& diagnostics);
  std::vector<KeyBinding> rows_, weft_;  // weft_: of keys.json
};

}  // namespace weft::app
