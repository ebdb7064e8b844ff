// A backward sweep over passes follows the links; a worklist holds what a history asks of passes behind the sweep.
#include "engine/graph/versions/live.h"

#include <cassert>

namespace weft::graph {

namespace {

// Where every link leads back: one backward sweep over the uses, without a branch on what they are.
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
    // A use without a writer stands for one: what it says of its pass is said already, of itself below.
    const std::size_t writer = link == kNone ? u : link;
    liveUse[writer] |= live;
    livePass[passOf[writer]] |= live;
    liveUse[u] = live;
  }
}

// The same where a history leads to its own pass or a later one.
class Sweep {
 public:
  Sweep(const FlatGraph& graph, Liveness& live)
      : graph_(graph), livePass_(live.pass.data()), liveUse_(live.use.data()), swept_(graph.passes.size()) {}

  void run() {
    while (swept_ > 0) {
      --swept_;
      if (livePass_[swept_] == 0) continue;
      enliven(swept_);
      while (!stack_.empty()) {
        const std::uint32_t u = stack_.back();
        stack_.pop_back();
        if (const std::uint32_t pass = graph_.links.passOf[u]; livePass_[pass] == 0)
          enliven(pass);
        else if (graph_.uses[u].access == Access::modify)
          follow(u);
      }
    }
  }

 private:
  void enliven(std::size_t pass) {
    livePass_[pass] = 1;
    const std::uint32_t first = graph_.passes[pass].firstUse, end = first + graph_.passes[pass].useCount;
    for (std::uint32_t u = first; u < end; ++u) {
      const FlatUse& use = graph_.uses[u];
      if (use.access == Access::read || use.keep) liveUse_[u] = 1;
      if (liveUse_[u] != 0) follow(u);
    }
  }
  void follow(std::uint32_t use) {
    graph_.links.forEachWriter(graph_.links.seen[use], [&](std::uint32_t writer) {
      if (liveUse_[writer] != 0) return;
      liveUse_[writer] = 1;
      if (const std::uint32_t pass = graph_.links.passOf[writer]; pass < swept_)
        livePass_[pass] = 1;
      else
        stack_.push_back(writer);
    });
  }

  const FlatGraph& graph_;
  std::uint8_t *const livePass_, *const liveUse_;
  std::vector<std::uint32_t> stack_;
  std::size_t swept_;  // passes from here on have been looked at; what is asked of them waits on the stack
};

}  // namespace

Liveness findLive(const FlatGraph& graph) {
  const VersionLinks& links = graph.links;
  assert(links.seen.size() == graph.uses.size());  // linkVersions was forgotten
  Liveness live;
  live.pass.assign(graph.passes.size(), 0);
  live.use.assign(graph.uses.size(), 0);
  const auto keep = [&](std::uint32_t writer) { live.use[writer] = live.pass[links.passOf[writer]] = 1; };
  links.forEachWriter(links.present, keep);
  for (const std::uint32_t output : links.outputs) links.forEachWriter(output, keep);
  for (std::size_t p = 0; p < graph.passes.size(); ++p) live.pass[p] |= graph.passes[p].sideEffect ? 1 : 0;
  if (links.forward)
    Sweep(graph, live).run();
  else
    sweepBack(graph, live.pass.data(), live.use.data());
  return live;
}

}  // namespace weft::graph
