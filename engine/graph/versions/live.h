// Finds the live passes, and the uses for which they are needed, along FlatGraph::links. There is no other such walk: the
// checks of expansion warn by its result, and compile() culls by it.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/graph/flat_graph.h"

namespace weft::graph {

// `pass`: 1 for what `present`, an output, a side effect or a history that a live pass reads needs, directly or through
// others. `use`: 1 for all reads of live passes, and for writes and modifies that are kept or that a live use sees.
struct Liveness {
  std::vector<std::uint8_t> pass, use;
};

// Linear in uses and runs, also for chains of histories: each link is followed at most once.
Liveness findLive(const FlatGraph& graph);

}  // namespace weft::graph
