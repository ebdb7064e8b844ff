// What compile() takes for granted, checked on a FlatGraph that did not come from expandGraph (neutral
// workloads, graphs made by a program). Linear in passes, uses and the sub-resources they touch. Reports
// everything at once; places are empty, because a FlatGraph of this kind has none: the messages name pass and
// resource.
#pragma once

#include "engine/base/diagnostic.h"
#include "engine/graph/flat_graph.h"

namespace weft::graph {

// False after errors: W096 duplicate names, W097 a read before any write, W098 a sub-resource touched twice
// by one pass (but for a feedback modify), W099 an index or range outside the resource, W063 a present that
// nothing writes.
bool validateFlat(const FlatGraph& graph, base::Diagnostics& diagnostics);

}  // namespace weft::graph
