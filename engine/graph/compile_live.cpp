// Versions and liveness. One forward scan links every use to the uses that made what it sees; a worklist from the roots
// then walks those links. Each link is followed at most once, so the cost is linear in uses, also for chains of
// histories, where a backward sweep would have to be repeated per link of the chain.
#include <cassert>

#include "engine/graph/compile_steps.h"

namespace weft::graph::steps {

namespace {

using Scratch = CompileScratch;

bool writes(const FlatUse& use) { return use.access != Access::read; }
bool seesVersion(const FlatUse& use) { return use.access != Access::write && use.history == 0; }

// Resources with several sub-resources get several cells only when some use touches them in part.
void markGranular(const FlatGraph& graph, Scratch& scratch) {
  const auto mark = [&](const FlatUse& use) {
    if (!isWhole(use, graph.resources[use.resource])) scratch.flags[use.resource] |= Scratch::kGranular;
  };
  for (const FlatUse& use : graph.uses) mark(use);
  for (const FlatUse& use : graph.outputs) mark(use);
  if (graph.present.resource != kNone) mark(graph.present);
}

// Several cells, perhaps of several writers: a list, without repeats that follow each other.
std::uint32_t linkCells(const FlatUse& use, const FlatResource& r, Scratch& scratch) {
  const auto at = static_cast<std::uint32_t>(scratch.lists.size());
  scratch.lists.push_back(0);
  scratch.forEachCell(use, r, [&](std::uint32_t cell) {
    const std::uint32_t writer = scratch.lastWriter[cell];
    if (writer == kNone || (scratch.lists.size() > at + 1 && scratch.lists.back() == writer)) return;
    scratch.lists.push_back(writer);
  });
  const auto count = static_cast<std::uint32_t>(scratch.lists.size()) - at - 1;
  if (count > 1) {
    scratch.lists[at] = count;
    return Scratch::kList | at;
  }
  const std::uint32_t only = count == 1 ? scratch.lists.back() : kNone;
  scratch.lists.resize(at);
  return only;
}

}  // namespace

void indexCells(const FlatGraph& graph, Scratch& scratch) {
  const std::size_t count = graph.resources.size();
  scratch.flags.resize(count);
  scratch.cellBase.resize(count);
  scratch.anyClear = scratch.anyHistory = scratch.anyGranular = scratch.anyStore = scratch.anyBuffer = false;
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
    scratch.anyHistory = scratch.anyHistory || r.history > 0;
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

void linkVersions(const FlatGraph& graph, Scratch& scratch) {
  assert(graph.uses.size() < Scratch::kList);
  scratch.lastWriter.assign(scratch.cellCount, kNone);
  scratch.previous.resize(graph.uses.size());
  scratch.passOf.resize(graph.uses.size());
  scratch.lists.clear();
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) {
    const std::uint32_t first = graph.passes[p].firstUse, end = first + graph.passes[p].useCount;
    for (std::uint32_t u = first; u < end; ++u) {
      const FlatUse& use = graph.uses[u];
      scratch.passOf[u] = p;
      if (!seesVersion(use))
        scratch.previous[u] = kNone;
      else if ((scratch.flags[use.resource] & Scratch::kGranular) == 0)
        scratch.previous[u] = scratch.lastWriter[scratch.cellBase[use.resource]];
      else
        scratch.previous[u] = linkCells(use, graph.resources[use.resource], scratch);
    }
    // After the reads of the whole pass: a pass never sees what it writes itself.
    for (std::uint32_t u = first; u < end; ++u) {
      const FlatUse& use = graph.uses[u];
      if (!writes(use)) continue;
      if ((scratch.flags[use.resource] & Scratch::kGranular) == 0)
        scratch.lastWriter[scratch.cellBase[use.resource]] = u;
      else
        scratch.forEachCell(use, graph.resources[use.resource],
                            [&](std::uint32_t cell) { scratch.lastWriter[cell] = u; });
    }
  }
}

void findLive(const FlatGraph& graph, Plan& plan, Scratch& scratch) {
  plan.attached.assign(graph.uses.size(), 0);
  scratch.livePass.assign(graph.passes.size(), 0);
  scratch.stack.clear();
  const auto demand = [&](std::uint32_t writer) {
    if (plan.attached[writer] != 0) return;
    plan.attached[writer] = 1;
    scratch.stack.push_back(writer);
  };
  const auto demandFinal = [&](const FlatUse& use) {
    scratch.forEachCell(use, graph.resources[use.resource], [&](std::uint32_t cell) {
      if (scratch.lastWriter[cell] != kNone) demand(scratch.lastWriter[cell]);
    });
  };
  const auto enliven = [&](std::uint32_t p) {
    scratch.livePass[p] = 1;
    const std::uint32_t first = graph.passes[p].firstUse, end = first + graph.passes[p].useCount;
    for (std::uint32_t u = first; u < end; ++u) {
      const FlatUse& use = graph.uses[u];
      if (writes(use)) {
        if (use.keep) demand(u);
        continue;
      }
      plan.attached[u] = 1;
      if (use.history > 0)
        demandFinal(use);  // x@-n: whatever is published in a frame will be read n frames later
      else
        scratch.forEachPrevious(u, demand);
    }
  };
  if (graph.present.resource != kNone) demandFinal(graph.present);
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
    if (graph.passes[p].sideEffect) enliven(p);
  while (!scratch.stack.empty()) {
    const std::uint32_t u = scratch.stack.back();
    scratch.stack.pop_back();
    if (scratch.livePass[scratch.passOf[u]] == 0) enliven(scratch.passOf[u]);
    if (graph.uses[u].access == Access::modify) scratch.forEachPrevious(u, demand);
  }
}

}  // namespace weft::graph::steps
