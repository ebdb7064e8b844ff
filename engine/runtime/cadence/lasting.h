// Finds the steps of a plan that later frames depend on: those that write what persists (histories, results that are kept,
// slices), and those whose results they need. The other steps serve only the picture of their frame. They may be left out
// of a frame that nobody will see, and no later frame changes. Does not: count what is read back for display.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/graph/plan.h"

namespace weft::runtime {

// Per step, 0 or 1. Linear in uses.
std::vector<std::uint8_t> findLastingSteps(const graph::Plan& plan);

}  // namespace weft::runtime
