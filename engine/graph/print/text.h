// The canonical text of a plan: order, barrier bits, clears, framebuffers, storage and who shares it, bytes,
// culled passes. Equal plans give equal text; fit to be committed as a golden and to be read by a person.
// With `explain`, each pass, barrier bit and storage says why (explain.h); that form is for reading, not for
// goldens.
#pragma once

#include <string>

#include "engine/graph/plan.h"

namespace weft::graph {

std::string dumpText(const Plan& plan, bool explain = false);

}  // namespace weft::graph
