// The fixed-function state of a pass, from "state" and the slots that it is for. Reports what cannot be and what would do nothing.
// Does not: know the names of types of passes.
#pragma once

#include <vector>

#include "engine/graph/expand/slots.h"

namespace weft::graph::expansion {

void fillState(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
               StateSpec& state);

}  // namespace weft::graph::expansion
