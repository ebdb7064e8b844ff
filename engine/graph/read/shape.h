// Trees of JSON against the schema of graphs (keys.h), and names that are misspelt where they are declared. What is one slip away
// from a key, a word or a name is reported and then read as that, so that nothing else is said of what is missing because of it.
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

// A resource that nothing names, while what is named more than once is not there and one slip away, gets that name.
void mendNames(GraphDesc& desc, text::Diagnostics& diagnostics);

}  // namespace weft::graph
