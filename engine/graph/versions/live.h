// Finds the live passes, and the uses for which they are needed, along FlatGraph::links. There is no other such walk: the
// checks of expansion warn by its result, and compile() culls by it.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/graph/flat_graph.h"
#include "engine/graph/plan.h"

namespace weft::graph {

// `pass`: 1 for what `present`, an output, a side effect or a history that a live pass reads needs, directly or through
// others. `use`: 1 for all reads of live passes, and for writes and modifies that are kept or that a live use sees.
struct Liveness {
  std::vector<std::uint8_t> pass, use;
};

// Linear in uses and runs, for each link of a chain of histories that leads forward again.
Liveness findLive(const FlatGraph& graph);

// Forms the groups of a graph (struct Groups in plan.h): all writers of a resource that has a history, that some pass
// modifies, or that a time-sliced group writes. A group with a pass in more than one slice is time-sliced: what it writes has
// one more copy, and all of it is published at once. It takes in the `on_change` passes whose results it reads, and the
// time-sliced groups that read an import it reads.

// Of the live passes, by the writes that are live.
Groups formGroups(const FlatGraph& graph, const Liveness& live);

}  // namespace weft::graph
