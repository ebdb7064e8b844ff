// Every hazard of a plan in steady state as an interval of positions on the circle of the frame that must
// hold a barrier with a given bit; and the placement of barriers that meets them all without redundant bits.
//
// Positions: 2t is Step::barriers of step t, 2t + 1 its barriersAfterClears; step S = steps.size() is the end
// of the frame (finalBarriers); the circle has 2 (S + 1) positions. `lo` is negative when the first access
// lies in an earlier frame, and never more than one circle before `hi`: whatever is older is stabbed by any
// barrier of the bit. Does not: name the accesses (explain.h finds them again when asked).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/graph/compile/scratch.h"
#include "engine/graph/plan.h"

namespace weft::graph {

struct HazardInterval {
  std::int32_t lo = 0, hi = 0;  // inclusive; a barrier at any position in between will do
};

// Per bit, in order of hi; of several intervals with one hi only the shortest, which implies the others.
using HazardIntervals = std::array<std::vector<HazardInterval>, kBarrierBitCount>;

// Reads steps, clears, attached, storage and lifetimes of `plan`; scratch must be that of its compile().
void collectHazards(const FlatGraph& graph, const Plan& plan, const CompileScratch& scratch,
                    HazardIntervals& hazards);

// Positions for one bit, ascending, as late as possible: no interval without one, none that can be left out.
// `circle` is 2 (S + 1).
std::vector<std::int32_t> stab(const std::vector<HazardInterval>& hazards, std::int32_t circle);

}  // namespace weft::graph
