// Links and checks a FlatGraph that did not come from expandGraph (neutral workloads, graphs made by a program). Versions
// are linked by the walk that expansion uses (versions/version_walk.h); what compile() relies on is checked along the way.
// The time is linear in passes, uses and the sub-resources they touch. Reports all mistakes at once. Such a graph has no
// places, so the messages name pass and resource.
#pragma once

#include "engine/base/diagnostic.h"
#include "engine/graph/flat_graph.h"

namespace weft::graph {

// Fills graph.links. False after errors: W096 duplicate names, W097 a read before any write, W098 a sub-resource touched
// twice by one pass, W099 an index or range outside the resource, W063 a present that nothing writes.
bool linkFlat(FlatGraph& graph, base::Diagnostics& diagnostics);

}  // namespace weft::graph
