// Compiles a FlatGraph to a Plan. The time is linear in passes and uses; only the flat arrays of FlatGraph are read, and
// nothing can fail any more. Does not: read names or texts, or say why (print/explain.h does).
#pragma once

#include <cstdint>
#include <memory>

#include "engine/graph/plan.h"

namespace weft::graph {

struct CompileOptions {
  bool share = true;            // false: every resource its own storage (fuzz)
  std::uint64_t orderSeed = 0;  // not 0: a random legal order instead of the declared one (fuzz)
  // The live passes, counted in declared order, that the random order may move; the others stay where they are.
  std::uint32_t orderFirst = 0, orderLast = ~0u;
};

// The graph must be valid and linked (by expandGraph, or by linkVersions): every read has a version, some
// pass writes what is presented (version zero is not enough), and imports are not written. The order of the plan is the
// declared order of the live passes. It is always legal, because a use refers to the latest version before it, and it is
// the order that a person reads in the file.
Plan compile(std::shared_ptr<const FlatGraph> graph, const CompileOptions& options = {});

}  // namespace weft::graph
