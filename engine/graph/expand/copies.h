// The two slots of a pass type without a shader, blit or mipmap, against each other: what GL would refuse, or would do in
// part, is refused here. Reports mistakes and never changes anything.
#pragma once

#include "engine/graph/expand/slots.h"

namespace weft::graph::expansion {

// W066 for slots that do not fit each other, W057 for their formats.
bool checkCopy(const SlotContext& context, const std::vector<SlotWork>& slots);

}  // namespace weft::graph::expansion
