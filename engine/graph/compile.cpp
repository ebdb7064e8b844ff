#include <utility>

#include "engine/graph/compile_scratch.h"
#include "engine/graph/compile_steps.h"
#include "engine/graph/plan.h"

namespace weft::graph {

Plan compile(std::shared_ptr<const FlatGraph> graph, const CompileOptions& options) {
  CompileScratch scratch;
  return compile(std::move(graph), options, scratch);
}

Plan compile(std::shared_ptr<const FlatGraph> graph, const CompileOptions& options, CompileScratch& scratch) {
  Plan plan;
  const FlatGraph& g = *graph;
  plan.graph = std::move(graph);
  steps::indexCells(g, scratch);
  steps::linkVersions(g, scratch);
  steps::findLive(g, plan, scratch);
  steps::orderPasses(g, options.orderSeed, plan, scratch);
  steps::findJobs(g, plan);
  steps::findLifetimes(g, plan, scratch);
  steps::placeStorage(g, options.share, plan, scratch);
  if (scratch.anyStore) steps::placeBarriers(g, plan, scratch);
  return plan;
}

}  // namespace weft::graph
