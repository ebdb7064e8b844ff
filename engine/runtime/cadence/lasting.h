// Finds the steps of a plan that later frames depend on even when nobody sees this one: those whose results are kept, slices,
// and those whose results they need. The other steps serve only the picture of their frame. They may be left out of a frame
// that is dropped, whose histories go back to what they were before it. Does not: count what is read back for display.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/graph/plan.h"

namespace weft::runtime {

// Per resource: a history that only `always` passes write, so that it is made anew in each frame.
std::vector<std::uint8_t> findFrameHistories(const graph::Plan& plan);

// Per step, 0 or 1. Linear in uses.
std::vector<std::uint8_t> findLastingSteps(const graph::Plan& plan);

}  // namespace weft::runtime
