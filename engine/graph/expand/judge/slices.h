// Reports what cannot be time-sliced (W077): a group with a writer or an input that changes in every frame, or with
// a dependency that leads out of the group and back into it. Does not: check a single stanza (stanza.h), or know what is
// live.
#pragma once

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

void checkSlices(Model& model);

}  // namespace weft::graph::expansion
