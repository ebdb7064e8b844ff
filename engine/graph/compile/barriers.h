// Barriers from hazards. A step of compile().
#pragma once

#include "engine/graph/compile/scratch.h"
#include "engine/graph/plan.h"

namespace weft::graph::steps {

// barrier masks
void placeBarriers(const FlatGraph& graph, Plan& plan, CompileScratch& scratch);

}  // namespace weft::graph::steps
