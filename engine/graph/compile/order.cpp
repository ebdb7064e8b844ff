// Order. Declared in steps.h. Declared order of the live passes is legal as it stands. A random legal order is drawn from the
// dependency edges: any pass whose predecessors have run may come next.
#include <algorithm>

#include "engine/graph/compile/steps.h"
#include "engine/text/hash.h"

namespace weft::graph {

namespace steps {

namespace {

void shuffle(const FlatGraph& graph, std::uint64_t seed, const Plan& plan, const CompileScratch& scratch,
             std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> waiting(graph.passes.size(), 0);
  std::vector<std::vector<std::uint32_t>> followers(graph.passes.size());
  for (const Dependency& edge : dependencies(graph, &plan.attached)) {
    if (scratch.livePass[edge.from] == 0 || scratch.livePass[edge.to] == 0) continue;
    ++waiting[edge.to];
    followers[edge.from].push_back(edge.to);
  }
  std::vector<std::uint32_t> ready;
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
    if (scratch.livePass[p] != 0 && waiting[p] == 0) ready.push_back(p);
  for (std::uint64_t draw = 0; !ready.empty(); ++draw) {
    const std::size_t pick = text::hashCombine(seed, draw) % ready.size();
    const std::uint32_t p = ready[pick];
    ready[pick] = ready.back();
    ready.pop_back();
    order.push_back(p);
    for (const std::uint32_t follower : followers[p])
      if (--waiting[follower] == 0) ready.push_back(follower);
  }
}

}  // namespace

void orderPasses(const FlatGraph& graph, const CompileOptions& options, Plan& plan,
                 const CompileScratch& scratch) {
  plan.stepOf.assign(graph.passes.size(), kNone);
  std::size_t live = 0;
  for (const std::uint8_t flag : scratch.livePass) live += flag;
  plan.steps.reserve(live);
  const auto append = [&](std::uint32_t p) {
    plan.stepOf[p] = static_cast<std::uint32_t>(plan.steps.size());
    plan.steps.push_back({});
    plan.steps.back().pass = p;
  };
  if (options.orderSeed == 0) {
    for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
      if (scratch.livePass[p] != 0) append(p);
    return;
  }
  std::vector<std::uint32_t> order;
  shuffle(graph, options.orderSeed, plan, scratch, order);
  for (const std::uint32_t p : order) append(p);
}

}  // namespace steps
}  // namespace weft::graph
