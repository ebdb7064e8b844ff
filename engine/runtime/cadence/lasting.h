// Which steps of a plan leave something behind their frame: what persists (histories, results that are kept,
// slices) and all that is made on the way to it. The others serve the picture alone: leaving them out of one
// frame that nobody will look at changes no later one. Does not: count what is read back for display.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/graph/plan.h"

namespace weft::runtime {

// Per step, 0 or 1. Linear in uses.
std::vector<std::uint8_t> findLastingSteps(const graph::Plan& plan);

}  // namespace weft::runtime
