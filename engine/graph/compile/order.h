// Order: the declared order of the live passes, or a random legal one. A step of compile().
#pragma once

#include "engine/graph/compile/compile.h"
#include "engine/graph/compile/scratch.h"
#include "engine/graph/plan.h"

namespace weft::graph::steps {

// Plan::steps, stepOf: declared order of the live passes, or a random legal one
void orderPasses(const FlatGraph& graph, const CompileOptions& options, Plan& plan,
                 const CompileScratch& scratch);

}  // namespace weft::graph::steps
