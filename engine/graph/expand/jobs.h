// Which passes of a graph run all or none and publish together (struct Jobs in plan.h). Passes of one group are one
// job, and so are the writers of a resource that is built jointly: one with history, one that somebody modifies, one of a
// group or in slices. A job with a pass in more than one slice is spread over frames; what it writes has one copy more and
// turns as a whole, so everybody who writes that is of the job too.
#pragma once

#include <cstdint>
#include <functional>

#include "engine/graph/plan.h"

namespace weft::graph {

// Of all passes that `isLive` accepts, through the writes that `isAttached` does. Linear but for a factor of
// next to nothing.
Jobs formJobs(const FlatGraph& graph, const std::function<bool(std::uint32_t pass)>& isLive,
              const std::function<bool(std::uint32_t use)>& isAttached);

}  // namespace weft::graph
