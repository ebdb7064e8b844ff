// Finds the hazards of a plan whose frames follow each other for ever, and places barriers against them without redundant
// bits. A hazard is an interval of positions, of which one must have a barrier with a given bit.
//
// Positions: 2t is Step::barriers of step t, 2t + 1 its barriersAfterClears; step S = steps.size() is the end of the
// frame (finalBarriers). The positions of a frame form a circle of 2 (S + 1), because the next frame follows. `lo` is
// negative when the first access is in an earlier frame. It is at most one circle before `hi`: a longer interval has
// every barrier of the bit in it. Does not: name the accesses (explain.h finds them again when asked).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/graph/compile/scratch.h"
#include "engine/graph/plan.h"

namespace weft::graph {

struct HazardInterval {
  std::int32_t lo = 0, hi = 0;  // inclusive; a barrier at any position from lo to hi serves
};

// Per bit, in order of hi; of several intervals with one hi only the shortest, which implies the others.
using HazardIntervals = std::array<std::vector<HazardInterval>, kBarrierBitCount>;

// Reads steps, clears, attached, storage and lifetimes of `plan`; scratch must be that of its compile().
void collectHazards(const FlatGraph& graph, const Plan& plan, const CompileScratch& scratch,
                    HazardIntervals& hazards);

// Positions for one bit, ascending and as late as possible. Every interval has one, and none can be left out.
// `circle` is 2 (S + 1).
std::vector<std::int32_t> stab(const std::vector<HazardInterval>& hazards, std::int32_t circle);

}  // namespace weft::graph
