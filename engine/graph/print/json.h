// A plan as JSON for tools: {"name", "bytes", "steps", "culled", "storages", "buffers", "resources",
// "final_barriers"}. Equal plans give equal text. With `explain`, passes, barriers and resources carry a
// "why".
#pragma once

#include <string>

#include "engine/graph/plan.h"

namespace weft::graph {

std::string dumpJson(const Plan& plan, bool explain = false);

}  // namespace weft::graph
