// Warnings about passes whose "update" does not fit what they read.
// Does not look at what shaders do: a pass that runs in every frame counts as one that writes something new in each.
#pragma once

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

// W083 for a live `once` pass that reads a history, what a pass writes in every frame, or an import that changes while the
// graph runs; and for an `on_change` pass that runs in every frame, because what it reads changes in each. One warning a
// pass and stanza. A `once` pass that runs again with others of its group is not judged.
void warnCadence(Model& model);

}  // namespace weft::graph::expansion
