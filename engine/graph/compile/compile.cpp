#include "engine/graph/compile/compile.h"

#include <utility>

#include "engine/graph/compile/steps.h"
#include "engine/graph/versions/versions.h"
#include "engine/text/limits.h"
#include "graph_sentences.h"

namespace weft::graph {

namespace {

using Scratch = CompileScratch;

// Resources with several sub-resources get several cells only when some use touches them in part.
void markGranular(const FlatGraph& graph, Scratch& scratch) {
  const auto mark = [&](const FlatUse& use) {
    if (!isWhole(use, graph.resources[use.resource])) scratch.flags[use.resource] |= Scratch::kGranular;
  };
  for (const FlatUse& use : graph.uses) mark(use);
  for (const FlatUse& use : graph.outputs) mark(use);
  if (graph.present.resource != kNone) mark(graph.present);
}

// flags, cellBase, cellCount
void indexCells(const FlatGraph& graph, Scratch& scratch) {
  const std::size_t count = graph.resources.size();
  scratch.flags.resize(count);
  scratch.cellBase.resize(count);
  bool anyMulti = false;
  for (std::size_t i = 0; i < count; ++i) {
    const FlatResource& r = graph.resources[i];
    std::uint8_t flags = 0;
    if (isBuffer(r)) flags |= Scratch::kBuffer;
    if (isImported(r)) flags |= Scratch::kImported;
    if (r.hasClear) flags |= Scratch::kClear;
    if (r.history > 0) flags |= Scratch::kPersistent;
    scratch.flags[i] = flags;
    scratch.cellBase[i] = static_cast<std::uint32_t>(i);
    anyMulti = anyMulti || subresourceCount(r) > 1;
    scratch.anyClear = scratch.anyClear || r.hasClear;
  }
  scratch.cellCount = static_cast<std::uint32_t>(count);
  if (!anyMulti) return;
  markGranular(graph, scratch);
  std::uint32_t base = 0;
  for (std::size_t i = 0; i < count; ++i) {
    scratch.cellBase[i] = base;
    const bool granular = (scratch.flags[i] & Scratch::kGranular) != 0;
    base += granular ? subresourceCount(graph.resources[i]) : 1u;
  }
  scratch.cellCount = base;
}

Plan compileFor(std::shared_ptr<const FlatGraph> graph, const CompileOptions& options,
                std::vector<BarrierReason>* reasons) {
  CompileScratch scratch;
  Plan plan;
  plan.options = options;
  const FlatGraph& g = *graph;
  plan.graph = std::move(graph);
  indexCells(g, scratch);
  Liveness live = findLive(g);
  plan.groups = formGroups(g, live);
  scratch.livePass = std::move(live.pass);
  plan.attached = std::move(live.use);
  steps::orderPasses(g, options, plan, scratch);
  steps::findLifetimes(g, plan, scratch);
  steps::placeStorage(g, options.share, plan, scratch);
  if (scratch.anyStore) steps::placeBarriers(g, plan, scratch, reasons);
  return plan;
}

}  // namespace

Plan compile(std::shared_ptr<const FlatGraph> graph, const CompileOptions& options) {
  return compileFor(std::move(graph), options, nullptr);
}

std::vector<BarrierReason> explainBarriers(const Plan& plan) {
  std::vector<BarrierReason> reasons;
  compileFor(plan.graph, plan.options, &reasons);
  return reasons;
}

bool checkMemory(const Plan& plan, text::Diagnostics& diagnostics) {
  const std::uint64_t most = text::raised(kMaxTextureBytes);
  if (plan.bytesAllocated <= most) return true;
  const FlatGraph& graph = *plan.graph;
  const auto bytesOf = [&](std::uint32_t r) {
    const bool own = !isImported(graph.resources[r]) && plan.firstStep[r] != kNone;
    return own ? graph.resources[r].bytes * plan.copiesOf(r) : 0;
  };
  std::uint32_t largest = 0;
  for (std::uint32_t r = 1; r < graph.resources.size(); ++r)
    if (bytesOf(r) > bytesOf(largest)) largest = r;
  text::Diagnostic& d = diagnostics.error(
      say::texturesTooLarge,
      largest < graph.resourcePlaces.size() ? graph.resourcePlaces[largest] : text::Place{}, graph.name,
      plan.bytesAllocated, most, graph.resourceNames[largest], bytesOf(largest));
  d.resource = graph.resourceNames[largest];
  if (const std::string raise = text::hintToRaise(kMaxTextureBytes, plan.bytesAllocated); !raise.empty())
    d.hint += "; " + raise;
  return false;
}

}  // namespace weft::graph
