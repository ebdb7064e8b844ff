// Lays an overlay over a source. Private to engine/graph/read.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/graph/read/overlay.h"

namespace weft::graph {

// Where a whole name stands in a source: in it, or in an include `below` it.
struct Found {
  std::vector<std::string> below;  // prefixes from the source down
  std::size_t index = 0;           // among the members of the section, or the stanzas of "passes"
  base::Place place;               // of its name
};

// What `name` names whole in `section` ("resources", "passes"…) of the source or of what it includes; nothing when there is
// none. Adds what was looked through to `looked`.
std::optional<Found> findWhole(SourceLoader& loader, const Source& source, const std::string& section,
                               std::string_view name, std::uint64_t& looked);
// The include whose prefix `name` begins with, before a '.', and its file; null when there is none, or no file.
struct Below {
  std::string prefix;
  std::shared_ptr<const Source> source;
};
Below includeOf(SourceLoader& loader, const Source& source, std::string_view name);
// The prefixes of the includes that a dotted name begins with, from the source down.
std::vector<std::string> includesOf(SourceLoader& loader, const Source& source, std::string_view name);
// The name within the file at the end of `below`; "" when it does not begin with these includes.
std::string_view nameBelow(std::string_view name, const std::vector<std::string>& below);
// Those of the names that end in one that is not whole, the shortest first; and a hint that says so, else names that are near.
std::vector<std::string> wholeOf(std::string_view wanted, const std::vector<std::string>& names);
std::string wholeHint(std::string_view wanted, const std::vector<std::string>& names);
// Every name in `section` of the source and of all it includes, its own first, without inputs: for hints.
std::vector<std::string> allNames(SourceLoader& loader, const Source& source, const std::string& section);

// The member of that key, or null.
base::JsonMember* memberOf(base::JsonValue& object, std::string_view key);
// What was probably meant by a key that the object does not have.
std::string hintForKey(const base::JsonValue& object, std::string_view key);
// "texture", "buffer", "import" or "input"; "alternatives" for what is no object; "" for an object without a kind.
std::string_view kindOf(const base::JsonValue& resource);
// "resources" to "resource".
std::string nounOf(const std::string& section);

// Name of a pass stanza, else the prefix of an include (which an overlay may also call by "name"). "" when it
// has none.
std::string stanzaName(const base::JsonValue& stanza);

// What a pass stanza writes and modifies: the names of the resources.
std::vector<std::string> writtenBy(const base::JsonValue& stanza);

// The array of "passes", or null.
base::JsonValue* passesOf(Source& source);
// The stanza without "before", "after" and "remove", called `name` in its own file; without a name when that is "".
base::JsonValue withoutPlace(const base::JsonValue& stanza, std::string_view name);
// Whether an entry that is not there yet declares something, instead of changing it.
bool declares(const std::string& section, const base::JsonMember& entry);

// Changes `target` as `overlay` says, and reports what does not fit. A preset keeps the name of the graph.
void applyOverlay(SourceLoader& loader, const base::JsonValue& overlay, bool preset, Source& target,
                  base::Diagnostics& diagnostics);

}  // namespace weft::graph
