#include "engine/graph/versions/live.h"

#include <cassert>

namespace weft::graph {

namespace {

// Where every link leads back: one backward sweep over the uses, without a branch on what they are. A worklist takes a third more
// of compile()'s time.
void sweepBack(const FlatGraph& graph, std::uint8_t* const livePass, std::uint8_t* const liveUse) {
  const VersionLinks& links = graph.links;
  const std::uint32_t* const passOf = links.passOf.data();
  for (std::size_t u = graph.uses.size(); u-- > 0;) {
    const FlatUse& use = graph.uses[u];
    const auto stays = static_cast<std::uint8_t>((use.access == Access::read ? 1 : 0) | (use.keep ? 1 : 0));
    const std::uint8_t live = livePass[passOf[u]] & (liveUse[u] | stays);
    const std::uint32_t link = links.seen[u];
    if (VersionLinks::hasRuns(link)) {
      liveUse[u] = live;
      if (live == 0) continue;
      links.forEachWriter(link,
                          [&](std::uint32_t writer) { liveUse[writer] = livePass[passOf[writer]] = 1; });
      continue;
    }
    // A use without a writer takes its own place: what it says of its pass is said already, of itself below.
    const std::size_t writer = link == kNone ? u : link;
    liveUse[writer] |= live;
    livePass[passOf[writer]] |= live;
    liveUse[u] = live;
  }
}

}  // namespace

Liveness findLive(const FlatGraph& graph) {
  const VersionLinks& links = graph.links;
  assert(links.seen.size() == graph.uses.size());  // linkVersions was forgotten
  Liveness live;
  live.pass.assign(graph.passes.size(), 0);
  live.use.assign(graph.uses.size(), 0);
  const auto eachRoot = [&](const auto& keep, const auto& enliven) {
    links.forEachWriter(links.present, keep);
    for (const std::uint32_t output : links.outputs) links.forEachWriter(output, keep);
    for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
      if (graph.passes[p].sideEffect) enliven(p);
  };
  if (!links.forward) {
    eachRoot([&](std::uint32_t use) { live.use[use] = live.pass[links.passOf[use]] = 1; },
             [&](std::uint32_t pass) { live.pass[pass] = 1; });
    sweepBack(graph, live.pass.data(), live.use.data());
    return live;
  }
  std::vector<std::uint32_t> open;  // live uses that were not looked at yet
  const auto keep = [&](std::uint32_t use) {
    if (live.use[use] == 0) open.push_back(use);
    live.use[use] = 1;
  };
  const auto enliven = [&](std::uint32_t pass) {
    if (live.pass[pass] != 0) return;
    live.pass[pass] = 1;
    const std::uint32_t first = graph.passes[pass].firstUse, end = first + graph.passes[pass].useCount;
    for (std::uint32_t u = first; u < end; ++u)
      if (graph.uses[u].access == Access::read || graph.uses[u].keep) keep(u);
  };
  eachRoot(keep, enliven);
  while (!open.empty()) {
    const std::uint32_t use = open.back();
    open.pop_back();
    enliven(links.passOf[use]);
    links.forEachWriter(links.seen[use], keep);
  }
  return live;
}

}  // namespace weft::graph
