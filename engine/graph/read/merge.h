// What overlays, presets and "like" do with the trees of files: merge member by member. Every value keeps the place at which it
// was written.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/text/json/dom.h"

namespace weft::graph {

// The member of that key, or null.
text::JsonMember* memberOf(text::JsonValue& object, std::string_view key);
// The value and all that is in it.
std::uint64_t valuesOf(const text::JsonValue& value);

// "texture", "buffer", "import" or "input"; "alternatives" for what is no object; "" for an object without a kind.
std::string_view kindOf(const text::JsonValue& resource);
// What an include stanza is called: "as", else the file's name without its ending. "" when it says neither.
std::string includePrefix(const text::JsonValue& stanza);
// Name of a pass stanza, else the prefix of an include (which an overlay may also call by "name"). "" when it has none.
std::string stanzaName(const text::JsonValue& stanza);

// Objects merge, null takes a member away, anything else replaces what is there.
struct Merge {
  bool keepsNull = false;   // null stays where nothing is there
  bool takesPlace = false;  // a merged object has the place of the one that is laid over it
  std::function<void(const text::JsonValue& into, const text::JsonMember& over)>
      nothingThere;  // for null to take away

  void run(text::JsonValue& into, const text::JsonMember& over) const;
};
// What was probably meant by a key that the object does not have.
std::string hintForKey(const text::JsonValue& object, std::string_view key);

// The stanzas of one file, each that is "like" one above it as if it were written out: all keys of the other, with its own laid
// over them. A parameter that the other declares is shared. Null after a report. What is made is kept in `made`.
std::vector<const text::JsonValue*> writeOut(const std::vector<text::JsonValue>& stanzas,
                                             std::deque<text::JsonValue>& made,
                                             text::Diagnostics& diagnostics);

}  // namespace weft::graph
