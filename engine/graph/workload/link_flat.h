// The door for a FlatGraph that did not come from expandGraph (neutral workloads, graphs made by a program): its versions
// are linked by the walk that expansion uses (versions/version_walk.h), and what compile() takes for granted is checked along
// the way. Linear in passes, uses and the sub-resources they touch. Reports everything at once; places are empty,
// because a FlatGraph of this kind has none: the messages name pass and resource.
#pragma once

#include "engine/base/diagnostic.h"
#include "engine/graph/flat_graph.h"

namespace weft::graph {

// Fills graph.links. False after errors: W096 duplicate names, W097 a read before any write, W098 a sub-resource touched
// twice by one pass, W099 an index or range outside the resource, W063 a present that nothing writes.
bool linkFlat(FlatGraph& graph, base::Diagnostics& diagnostics);

}  // namespace weft::graph
