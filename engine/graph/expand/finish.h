// What looks at the versions after the last pass: present, outputs, histories and their resets, age(), exact copies.
#pragma once

#include <vector>

#include "engine/graph/expand/passes.h"

namespace weft::graph::expansion {

// present, outputs, histories, age(), exact copies: everything that looks at the versions after the last pass.
void finishGraph(Model& model, const std::vector<DeferredUniform>& deferred);

}  // namespace weft::graph::expansion
