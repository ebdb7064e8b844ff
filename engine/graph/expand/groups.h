// Which passes of a graph run all or none and publish together (struct Groups in plan.h): those that name one "group", and
// the writers of a resource that is built jointly: one with history, one that somebody modifies, one of a group or in
// slices. A group with a pass in more than one slice is time-sliced; what it writes has one copy more and turns as a
// whole, so everybody who writes that is of the group too.
#pragma once

#include <cstdint>
#include <functional>

#include "engine/graph/plan.h"

namespace weft::graph {

// Of all passes that `isLive` accepts, through the writes that `isAttached` does. Linear but for a factor of
// next to nothing.
Groups formGroups(const FlatGraph& graph, const std::function<bool(std::uint32_t pass)>& isLive,
                  const std::function<bool(std::uint32_t use)>& isAttached);

}  // namespace weft::graph
