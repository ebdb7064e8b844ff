// What changes from one plan to another: passes added, removed and moved, barrier bits, textures and bytes. Passes and
// resources are the same when their names are. Does not: compare pictures, or the text of shaders.
#pragma once

#include <string>

#include "engine/graph/plan.h"

namespace weft::graph {

// A line for each difference, then the bytes; "" when the plans do the same.
std::string diffText(const Plan& before, const Plan& after);

}  // namespace weft::graph
