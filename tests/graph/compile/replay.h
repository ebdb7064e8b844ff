// What a frame's pixels would be, as symbols: every write is a hash of its use, of all its pass saw and, for
// a modify, of what was there. Two replays that show equal symbols would show equal pictures.
//  - showDeclared: the meaning of a graph. Every pass, culled or not, in declared order, each resource with
//  memory of
//    its own, cleared at the start of the frame.
//  - showPlanned: the plan on its physical memory, step by step, clears where it says; memory that a plan
//  shares keeps
//    what the last owner left there.
// Both run every pass in every frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/graph/plan.h"

namespace weft::graph::replay {

// Per frame: what is presented, then each live output of `plan`, sub-resource by sub-resource; and what every
// live pass with a side effect saw.
struct Shown {
  std::vector<std::uint64_t> symbols;
  friend bool operator==(const Shown&, const Shown&) = default;
};

Shown showDeclared(const Plan& plan, std::size_t frames);
Shown showPlanned(const Plan& plan, std::size_t frames);

}  // namespace weft::graph::replay
