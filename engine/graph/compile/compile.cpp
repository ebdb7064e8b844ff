#include "engine/graph/compile/compile.h"

#include <utility>

#include "engine/graph/compile/barriers.h"
#include "engine/graph/compile/cells.h"
#include "engine/graph/compile/lifetimes.h"
#include "engine/graph/compile/order.h"
#include "engine/graph/compile/scratch.h"
#include "engine/graph/compile/storage.h"
#include "engine/graph/versions/groups.h"
#include "engine/graph/versions/live.h"

namespace weft::graph {

Plan compile(std::shared_ptr<const FlatGraph> graph, const CompileOptions& options) {
  CompileScratch scratch;
  Plan plan;
  const FlatGraph& g = *graph;
  plan.graph = std::move(graph);
  steps::indexCells(g, scratch);
  Liveness live = findLive(g);
  scratch.livePass = std::move(live.pass);
  plan.attached = std::move(live.use);
  steps::orderPasses(g, options, plan, scratch);
  plan.groups = formGroups(
      g, [&](std::uint32_t p) { return plan.stepOf[p] != kNone; },
      [&](std::uint32_t u) { return plan.attached[u] != 0; });
  steps::findLifetimes(g, plan, scratch);
  steps::placeStorage(g, options.share, plan, scratch);
  if (scratch.anyStore) steps::placeBarriers(g, plan, scratch);
  return plan;
}

}  // namespace weft::graph
