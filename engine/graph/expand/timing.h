// Timed passes: `always` passes whose `enabled`, or that of an include around them, contains age(). They run only in
// frames in which it holds. This finds these conditions, and checks that only passes with the same condition use what a
// timed pass makes, unless it was there before. Does not: evaluate a condition.
#pragma once

#include <cstdint>

#include "engine/graph/expand/slots.h"

namespace weft::graph::expansion {

// The number of a stanza's condition (into Model::timings, from 1), or 0 when it is not timed. `outer` is that of the
// include around it. Equal conditions of one file have one number. Reports what cannot be timed.
std::uint32_t timingOf(Model& model, Scope& scope, const PassDesc& desc, std::uint32_t outer);

// Whether the pass of `context` may write or modify what the slot means. If so, the resource counts as made from then on.
bool mayMake(const SlotContext& context, const SlotWork& work);

// Reports that the pass uses what timed passes with another condition make.
void reportMadeAtTimes(const SlotContext& context, const SlotDesc& slot, const SlotWork& work);

}  // namespace weft::graph::expansion
