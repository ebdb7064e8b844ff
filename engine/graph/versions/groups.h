// Forms the groups of a graph (struct Groups in plan.h): all writers of a resource that has a history, that some pass
// modifies, or that a time-sliced group writes. A group with a pass in more than one slice is time-sliced: what it writes has
// one more copy, and all of it is published at once. It takes in the `on_change` passes whose results it reads, and the
// time-sliced groups that read an import it reads.
#pragma once

#include "engine/graph/plan.h"
#include "engine/graph/versions/live.h"

namespace weft::graph {

// Of the live passes, by the writes that are live.
Groups formGroups(const FlatGraph& graph, const Liveness& live);

}  // namespace weft::graph
