// What the steps of compile() ask of each resource: flags, and whether it is followed as one cell or by sub-resource.
#pragma once

#include "engine/graph/compile/scratch.h"

namespace weft::graph::steps {

// flags, cellBase, cellCount
void indexCells(const FlatGraph& graph, CompileScratch& scratch);

}  // namespace weft::graph::steps
