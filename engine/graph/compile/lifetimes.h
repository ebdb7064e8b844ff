// Lifetimes in steps, clears of version zero, persistence and the bytes each step binds. A step of compile().
#pragma once

#include "engine/graph/compile/scratch.h"
#include "engine/graph/plan.h"

namespace weft::graph::steps {

// firstStep, lastStep, persistent, clears, outputLive, bytesBound, and births
void findLifetimes(const FlatGraph& graph, Plan& plan, CompileScratch& scratch);

}  // namespace weft::graph::steps
