// Warns of what the files declare and no pass, list or expression names: resources, inputs, a history that nobody reads, and
// alternatives that cannot be reached; and of lists of the scene that no pass draws. Does not: look at parameters, lets and parts of resources (unused.h), or at passes (culled.h).
#pragma once

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

// To be called when the graph has no errors.
void warnUnnamed(Model& model);

}  // namespace weft::graph::expansion
