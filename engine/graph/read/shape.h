// Trees of JSON against the schema of graphs (keys.h). What is one slip away from a key or a word is reported and then read as
// that, so that nothing else is said of what is missing because of it.
#pragma once

#include "engine/graph/desc.h"
#include "engine/text/diagnostic.h"
#include "engine/text/json/dom.h"

namespace weft::graph {

// Of one file, before it is laid over others: reports keys that are one slip away from another, or another program's word for
// it, and renames them. `preset`: the file is laid over a graph although it extends none.
void mendKeys(text::JsonValue& root, bool preset, text::Diagnostics& diagnostics);
// Of a whole graph: Code::wrongType, unknownKey, missingKey, unknownWord and keysExclude. What does not fit becomes
// `absent`, at its place: the readers take the rest as it is.
void checkShape(text::JsonValue& root, text::Diagnostics& diagnostics);

}  // namespace weft::graph
