// What cannot be spread over frames: a writer or an input of every frame, and a way out of a group and back into it (W77).
// Does not: judge a single stanza (expand_stanza.cpp), or know what is live.
#pragma once

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

void checkSlices(Model& model);

}  // namespace weft::graph::expansion
