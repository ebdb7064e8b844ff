// Warnings about passes that are culled by mistake.
#pragma once

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

// Warns of an enabled pass whose output is overwritten or never read, unless something that is switched off
// now (a disabled pass, a slot whose condition is false, an alternative not chosen) would read it; and of a
// graph that shows nothing.
void warnUnread(Model& model);

}  // namespace weft::graph::expansion
