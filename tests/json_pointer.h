// JSON pointers (RFC 6901), for tests that name values by them.
#pragma once

#include <charconv>
#include <string>
#include <string_view>

#include "engine/text/json/dom.h"

namespace weft::test {

using text::JsonValue;

// Null when there is none.
inline const JsonValue* findPointer(const JsonValue& root, std::string_view pointer) {
  const JsonValue* at = &root;
  while (at && !pointer.empty()) {
    pointer.remove_prefix(1);
    std::string key(pointer.substr(0, pointer.find('/')));
    pointer.remove_prefix(key.size());
    if (at->is(JsonValue::Type::array)) {
      std::size_t index = at->items.size();
      std::from_chars(key.data(), key.data() + key.size(), index);
      at = index < at->items.size() ? &at->items[index] : nullptr;
      continue;
    }
    for (std::size_t tilde = key.find('~'); tilde != std::string::npos; tilde = key.find('~', tilde + 1))
      key.replace(tilde, 2, key.substr(tilde, 2) == "~1" ? "/" : "~");
    at = at->find(key);
  }
  return at;
}

// The pointer to where a diagnostic about this text is.
inline std::string pointerTo(std::string_view json, const text::Diagnostic& d) {
  return text::pointerAt(text::parseJsonTree(json).root, text::offsetOf(json, d.place.inFile()));
}

}  // namespace weft::test
