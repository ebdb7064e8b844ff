// What is alive, and what that makes of missing versions: an error in a live pass, a warning in a culled one,
// with the reason (a disabled writer, a later writer, a cycle, no writer) and the fixes. Also warnings about
// passes that are culled by mistake. What is alive is found by findLive (engine/graph/versions/live.h), by
// which the compiler culls; here is only decided what to say.
#pragma once

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

// Reports every MissingRead.
void judgeMissing(Model& model);

// Warns of an enabled pass whose output is overwritten or never read, unless something that is switched off
// now (a disabled pass, a slot whose condition is false, an alternative not chosen) would read it; and of a
// graph that shows nothing.
void warnUnread(Model& model);

}  // namespace weft::graph::expansion
