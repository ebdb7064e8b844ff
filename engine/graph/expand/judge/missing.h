// What missing versions make of a graph: an error in a live pass, a warning in a culled one, with the reason (a pass that
// is disabled, removed or never repeated, a later writer, a cycle, no writer) and the fixes. What is alive is found by
// findLive (engine/graph/versions/live.h), by which the compiler culls; here is only decided what to say.
#pragma once

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

// Reports every MissingRead.
void judgeMissing(Model& model);

}  // namespace weft::graph::expansion
