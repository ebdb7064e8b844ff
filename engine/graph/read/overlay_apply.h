// Lays an overlay over a source. Private to engine/graph/read.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/graph/read/overlay.h"

namespace weft::graph {

// Where a name stands in a source: in it, or in an include `below` it.
struct Found {
  std::string name;                // dotted, as seen from the source
  std::vector<std::string> below;  // prefixes from the source down
  std::size_t index = 0;           // among the members of the section, or the stanzas of "passes"
};

// Everything in `section` ("resources", "passes"…) of the source and of all it includes, its own first.
// Inputs are left out: they stand for a resource of another file.
std::vector<Found> findAll(SourceLoader& loader, const Source& source, const std::string& section);

// The member of that key, or null.
base::JsonMember* memberOf(base::JsonValue& object, std::string_view key);
// What was probably meant by a key that the object does not have.
std::string hintForKey(const base::JsonValue& object, std::string_view key);
// "texture", "buffer", "import" or "input"; "alternatives" for what is no object; "" for an object without a kind.
std::string_view kindOf(const base::JsonValue& resource);
// "resources" to "resource".
std::string nounOf(const std::string& section);
std::string namesOf(const std::vector<Found>& all, const std::vector<std::size_t>& some);

// Name of a pass stanza, else the prefix of an include (which an overlay may also call by "name"). "" when it
// has none.
std::string stanzaName(const base::JsonValue& stanza);

// What a pass stanza writes and modifies: the names of the resources.
std::vector<std::string> writtenBy(const base::JsonValue& stanza);

// The array of "passes", or null.
base::JsonValue* passesOf(Source& source);
// The stanza without "before", "after" and "remove"; without its name too unless `named`.
base::JsonValue withoutPlace(const base::JsonValue& stanza, bool named);
// Whether an entry that is not there yet declares something, instead of changing it.
bool isWhole(const std::string& section, const base::JsonMember& entry);

// Changes `target` as `overlay` says, and reports what does not fit. A preset keeps the name of the graph.
void applyOverlay(SourceLoader& loader, const base::JsonValue& overlay, bool preset, Source& target,
                  base::Diagnostics& diagnostics);

}  // namespace weft::graph
