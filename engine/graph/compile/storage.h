// Physical textures by class, transient buffers by offset. A step of compile().
#pragma once

#include "engine/graph/compile/scratch.h"
#include "engine/graph/plan.h"

namespace weft::graph::steps {

// storages, storageOf, bufferOffsetOf, arenaBytes, bytes
void placeStorage(const FlatGraph& graph, bool share, Plan& plan, CompileScratch& scratch);

}  // namespace weft::graph::steps
