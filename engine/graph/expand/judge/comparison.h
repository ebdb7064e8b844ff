// What `as compare` means where the reference names no comparison: that of the depth test which made the map. Does not: read what
// the reference says (read/ref_words.h).
#pragma once

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

// Settles Sampler::function of every slot that compares; W056 where nothing says how. After the versions are linked.
void settleComparisons(Model& model);

}  // namespace weft::graph::expansion
