// Misspelt keys of a file, before it is laid over others or read: "histroy" is reported, and then stands for "history", so that
// nothing else is said of what is missing because of it. Private to engine/graph/read. Does not: report keys that are near no
// other (ReadContext::checkKeys does).
#pragma once

#include "engine/base/diagnostic.h"
#include "engine/base/json/dom.h"
#include "engine/graph/desc.h"

namespace weft::graph {

// `preset`: the file is laid over a graph although it extends none.
void mendKeys(base::JsonValue& root, bool preset, base::Diagnostics& diagnostics);

// A resource that nothing names, while what is named is not there and one slip away, is misspelt where it is declared, or where
// it is named, if that is in one place: it gets the other name.
void mendNames(GraphDesc& desc, base::Diagnostics& diagnostics);

}  // namespace weft::graph
