// The JSON Schema (draft 2020-12) of graph files, printed from the tables in keys.h that the reader itself uses.
// docs/graph.schema.json is this text; editors find it through "$schema". It describes shapes and words, not meaning:
// names, expressions and references are checked by the reader and by expansion.
#pragma once

#include <string>

namespace weft::graph {

std::string graphSchema();

}  // namespace weft::graph
