// Timed passes: `always`, but run only in frames in which their `enabled`, or that of an include around them,
// holds, because it contains age(). Which such conditions there are, and that what a timed pass makes is used
// by passes of the same condition only, or was there before. Does not: evaluate a condition.
#pragma once

#include <cstdint>

#include "engine/graph/expand/slots.h"

namespace weft::graph::expansion {

// The number of the condition of a stanza inside one of number `outer`: into Model::timings, from 1; 0: none. Equal
// conditions of one file are the same. Reports what cannot be timed.
std::uint32_t timingOf(Model& model, Scope& scope, const PassDesc& desc, std::uint32_t outer);

// Whether the pass of `context` may write or modify what the slot means; from then on the resource is made.
bool mayMake(const SlotContext& context, const SlotWork& work);

// Reports that the pass uses what timed passes of another condition make.
void reportMadeAtTimes(const SlotContext& context, const SlotDesc& slot, const Entity& entity);

}  // namespace weft::graph::expansion
