// Warnings about what a file declares and nothing uses: parameters, lets, and levels, layers and elements of textures.
// Does not look at which passes run: what a disabled pass or a condition that is false now would use counts as used.
#pragma once

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

// Whether nothing may have been laid over the file since this was written there.
bool isOnTop(const Scope& scope, const Place& place);

// W089 for each parameter and each `let` of the opened file that no expression names, for each parameter of an included
// file, and for each texture or buffer of which all references select the same one level, layer or element. What lies under
// an overlay or a preset is not judged: they may have taken away what used it.
void warnUnused(Model& model);

}  // namespace weft::graph::expansion
