// Forms the groups of a graph (struct Groups in plan.h): all writers of a resource that has a history, that some pass
// modifies, or that a time-sliced group writes. A group with a pass in more than one slice is time-sliced: what it writes has
// one more copy, and all of it is published at once. It takes in the `on_change` passes whose results it reads, and the
// time-sliced groups that read an import it reads.
#pragma once

#include <cstdint>
#include <functional>

#include "engine/graph/plan.h"

namespace weft::graph {

// Counts only passes that `isLive` accepts and writes that `isAttached` accepts.
Groups formGroups(const FlatGraph& graph, const std::function<bool(std::uint32_t pass)>& isLive,
                  const std::function<bool(std::uint32_t use)>& isAttached);

}  // namespace weft::graph
