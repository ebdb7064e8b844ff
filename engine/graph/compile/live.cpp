// Versions and liveness. One forward scan links every use to the uses that made what it sees; a backward
// sweep then follows those links, with a worklist for what a history asks of passes behind the sweep. Each
// link is followed at most once, so the cost is linear in uses, also for chains of histories, where a plain
// sweep would be repeated per link.
#include "engine/graph/compile/live.h"

#include <cassert>

namespace weft::graph::steps {

namespace {

using Scratch = CompileScratch;

bool writes(const FlatUse& use) {
  return use.access != Access::read;
}
bool seesVersion(const FlatUse& use) {
  return use.access != Access::write && use.history == 0;
}

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
  const std::size_t uses = graph.uses.size();
  // One entry more in each: where branchless stores go that mean nothing.
  scratch.lastWriter.assign(scratch.cellCount + 1, kNone);
  scratch.previous.resize(uses);
  scratch.passOf.resize(uses + 1);
  scratch.stays.resize(uses);
  scratch.passOf[uses] = static_cast<std::uint32_t>(graph.passes.size());
  scratch.lists.clear();
  std::uint32_t* const last = scratch.lastWriter.data();
  for (std::uint32_t p = 0, u = 0; p < graph.passes.size(); ++p) {
    assert(graph.passes[p].firstUse == u);  // uses stand grouped by pass, in the order of the passes
    for (const std::uint32_t end = u + graph.passes[p].useCount; u < end; ++u) {
      const FlatUse& use = graph.uses[u];
      scratch.passOf[u] = p;
      scratch.stays[u] = use.access == Access::read || use.keep ? 1 : 0;
      if ((scratch.flags[use.resource] & Scratch::kGranular) == 0) {
        const std::uint32_t cell = scratch.cellBase[use.resource];
        scratch.previous[u] = seesVersion(use) ? last[cell] : kNone;
        last[writes(use) ? cell : scratch.cellCount] = u;
        continue;
      }
      const FlatResource& r = graph.resources[use.resource];
      scratch.previous[u] = seesVersion(use) ? linkCells(use, r, scratch) : kNone;
      if (writes(use)) scratch.forEachCell(use, r, [&](std::uint32_t cell) { last[cell] = u; });
    }
  }
}

namespace {

// Without histories every link leads back: one backward sweep over the uses, without a branch on what they
// are.
void sweepLive(const FlatGraph& graph, Plan& plan, Scratch& scratch) {
  const std::size_t uses = graph.uses.size();
  std::uint8_t* const attached = plan.attached.data();
  std::uint8_t* const live = scratch.livePass.data();
  for (std::size_t u = uses; u-- > 0;) {
    const std::uint8_t a = live[scratch.passOf[u]] & (attached[u] | scratch.stays[u]);
    attached[u] = a;
    std::uint32_t writer = a != 0 ? scratch.previous[u] : kNone;
    if ((writer & Scratch::kList) != 0 && writer != kNone) {
      scratch.forEachPrevious(static_cast<std::uint32_t>(u), [&](std::uint32_t w) {
        attached[w] = 1;
        live[scratch.passOf[w]] = 1;
      });
      continue;
    }
    writer = writer == kNone ? static_cast<std::uint32_t>(uses) : writer;
    attached[writer] = 1;
    live[scratch.passOf[writer]] = 1;
  }
}

}  // namespace

void findLive(const FlatGraph& graph, Plan& plan, Scratch& scratch) {
  plan.attached.assign(graph.uses.size() + 1, 0);
  scratch.livePass.assign(graph.passes.size() + 1, 0);
  scratch.stack.clear();
  std::uint8_t* const attached = plan.attached.data();
  std::uint8_t* const live = scratch.livePass.data();
  // Passes from `swept` on have been looked at; what is demanded of them waits on the stack.
  auto swept = static_cast<std::uint32_t>(graph.passes.size());
  const auto demand = [&](std::uint32_t writer) {
    if (attached[writer] != 0) return;
    attached[writer] = 1;
    const std::uint32_t p = scratch.passOf[writer];
    if (p >= swept)
      scratch.stack.push_back(writer);
    else
      live[p] = 1;
  };
  const auto demandFinal = [&](const FlatUse& use) {
    scratch.forEachCell(use, graph.resources[use.resource], [&](std::uint32_t cell) {
      if (scratch.lastWriter[cell] != kNone) demand(scratch.lastWriter[cell]);
    });
  };
  const auto enliven = [&](std::uint32_t p) {
    live[p] = 1;
    const std::uint32_t first = graph.passes[p].firstUse, end = first + graph.passes[p].useCount;
    for (std::uint32_t u = first; u < end; ++u) {
      const FlatUse& use = graph.uses[u];
      if (use.access == Access::read) {
        attached[u] = 1;
        if (use.history > 0) {
          demandFinal(use);  // x@-n: whatever is published in a frame will be read n frames later
          continue;
        }
      } else {
        if (use.keep) attached[u] = 1;
        if (use.access == Access::write || attached[u] == 0) continue;
      }
      scratch.forEachPrevious(u, demand);
    }
  };
  if (graph.present.resource != kNone) demandFinal(graph.present);
  for (std::size_t p = 0; p < graph.passes.size(); ++p) live[p] |= graph.passes[p].sideEffect ? 1 : 0;
  if (!scratch.anyHistory) {
    sweepLive(graph, plan, scratch);
    swept = 0;
  }
  while (swept > 0) {
    --swept;
    if (live[swept] == 0) continue;
    enliven(swept);
    // Only a history can ask for something at or after the pass that reads it.
    while (!scratch.stack.empty()) {
      const std::uint32_t u = scratch.stack.back();
      scratch.stack.pop_back();
      if (live[scratch.passOf[u]] == 0)
        enliven(scratch.passOf[u]);
      else if (graph.uses[u].access == Access::modify)
        scratch.forEachPrevious(u, demand);
    }
  }
  plan.attached.pop_back();
  scratch.livePass.pop_back();
}

}  // namespace weft::graph::steps
