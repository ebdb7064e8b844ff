#include "engine/graph/compile/cells.h"

namespace weft::graph::steps {

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

}  // namespace

void indexCells(const FlatGraph& graph, Scratch& scratch) {
  const std::size_t count = graph.resources.size();
  scratch.flags.resize(count);
  scratch.cellBase.resize(count);
  scratch.anyClear = scratch.anyGranular = scratch.anyStore = scratch.anyBuffer = false;
  bool anyMulti = false;
  for (std::size_t i = 0; i < count; ++i) {
    const FlatResource& r = graph.resources[i];
    std::uint8_t flags = 0;
    if (isBuffer(r)) flags |= Scratch::kBuffer;
    if (isImported(r)) flags |= Scratch::kImported;
    if (r.hasClear) flags |= Scratch::kClear;
    if (r.history > 0) flags |= Scratch::kHistory | Scratch::kPersistent;
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
    scratch.anyGranular = scratch.anyGranular || granular;
  }
  scratch.cellCount = base;
}

}  // namespace weft::graph::steps
