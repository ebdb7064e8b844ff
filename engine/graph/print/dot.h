// A plan as a Graphviz graph: live passes as boxes in execution order, culled ones greyed, resources as
// ellipses, histories dashed, barrier bits under the pass they come before. For `dot -Tsvg`.
#pragma once

#include <string>

#include "engine/graph/plan.h"

namespace weft::graph {

std::string dumpDot(const Plan& plan);

}  // namespace weft::graph
