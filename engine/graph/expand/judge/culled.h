// Warnings about enabled passes that do not reach the picture, and slots that stay empty because their writer stands below.
#pragma once

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

// Warns of each enabled pass that reaches neither the picture nor an output, and of what a pass draws that another throws
// away, with the reason: overwritten, its reader stands above it, nobody reads it. Passes that only feed such a pass are
// named in its message. What would be read if all that is switched off now (a disabled pass, a condition that is false, a
// level that is not there at this size) were there is no mistake. Also warns of a slot that stays empty, or reads what
// "clear" says, because a pass below writes what it reads; and of a graph that shows nothing.
void warnUnread(Model& model);

}  // namespace weft::graph::expansion
