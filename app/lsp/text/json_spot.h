// A place in the tree of a JSON text, as an editor asks for it: also in a text that is being typed.
#pragma once

#include <string_view>
#include <vector>

#include "app/lsp/text/positions.h"
#include "engine/base/json/dom.h"

namespace weft::app::lsp {

using base::JsonMember;
using base::JsonValue;

// The bytes of a value; of a string or a key without its quotes.
Range rangeOf(const JsonValue& value);
Range inside(const JsonValue& string);
Range inside(const JsonMember& key);
// The text of a member that is a string, or "".
std::string_view textOf(const JsonValue& object, std::string_view key);

// A value on the way from the root to another.
struct Step {
  const JsonValue* value = nullptr;
  const JsonMember* member = nullptr;  // null of the root and in arrays
};
using Way = std::vector<Step>;  // never empty
// The keys on the way; "[]" for items of arrays.
std::vector<std::string_view> keysOn(const Way& way);

struct Spot {
  Way way;             // to the innermost value here, or to the container around an empty place
  bool inKey = false;  // in the key of the last
  bool atKey = false;  // in an object, where a key may begin
  bool inComment = false;
  const JsonValue& value() const { return *way.back().value; }
};
Spot spotAt(const base::JsonTree& tree, std::size_t offset);

}  // namespace weft::app::lsp
