// Versions and liveness: who made what each use sees, and which passes somebody needs. A step of compile().
#pragma once

#include "engine/graph/compile/scratch.h"
#include "engine/graph/plan.h"

namespace weft::graph::steps {

// flags, cellBase
void indexCells(const FlatGraph& graph, CompileScratch& scratch);
// previous, lists, passOf, lastWriter: which use made the version that each use sees
void linkVersions(const FlatGraph& graph, CompileScratch& scratch);
// livePass, Plan::attached: from the roots along the links
void findLive(const FlatGraph& graph, Plan& plan, CompileScratch& scratch);

}  // namespace weft::graph::steps
