// The walk over all passes in declared order: includes, repeats, enabled or not, slots, versions, and what
// goes into the FlatGraph. Missing versions are only recorded; live.h decides which are errors.
#pragma once

#include "engine/graph/expand/slots.h"
#include "engine/graph/expand/spec.h"

namespace weft::graph::expansion {

// Of a graph, each instance of a repeat counted; `--limit` raises them.
constexpr std::uint64_t kMostPasses = 4096;
constexpr std::uint64_t kMostSlotsOfPass = 1024;  // slots, parameters and defines
constexpr std::uint64_t kMostSlots = std::uint64_t{1}
                                     << 18;  // of all passes, and the versions that they read

// A uniform or define of a pass, and the scope and indices with which its expression is evaluated.
struct DeferredUniform {
  std::uint32_t pass = 0;
  DeferredValue value;
  Scope* scope = nullptr;
  std::vector<Names::Index> indices;
};

// Fills passes, uses, slots, specs, disabled and groupNames.
void expandPasses(Model& model, std::vector<DeferredUniform>& deferred);

}  // namespace weft::graph::expansion
