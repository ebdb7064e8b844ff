// The edges between passes (compile.h) and an order by them. Declared in steps.h. Declared order of the live passes is legal as it
// stands. A random legal order is drawn from the edges: any pass whose predecessors have run may come next.

#include <algorithm>

#include "engine/graph/compile/compile.h"
#include "engine/graph/compile/steps.h"
#include "engine/graph/subresource.h"
#include "engine/text/hash.h"

namespace weft::graph {

std::vector<Dependency> dependencies(const FlatGraph& graph, const std::vector<std::uint8_t>* attached) {
  const auto orders = [&](std::uint32_t u) {
    return (!attached || (*attached)[u] != 0) && graph.uses[u].history == 0;
  };
  std::vector<std::uint32_t> base(graph.resources.size() + 1, 0);
  for (std::size_t i = 0; i < graph.resources.size(); ++i)
    base[i + 1] = base[i] + subresourceCount(graph.resources[i]);
  std::vector<std::uint32_t> writer(base.back(), kNone);  // per sub-resource: pass; among attached uses
  std::vector<std::vector<std::uint32_t>> readers(base.back());  // passes since that writer
  std::vector<Dependency> edges;
  const auto add = [&](std::uint32_t from, std::uint32_t to, std::uint32_t resource, Dependency::Type type) {
    if (from != kNone && from != to) edges.push_back({from, to, resource, type});
  };
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) {
    const auto block = static_cast<std::ptrdiff_t>(edges.size());
    const auto eachCell = [&](bool writing, auto&& f) {
      for (const std::uint32_t u : graph.usesOf(p)) {
        const FlatUse& use = graph.uses[u];
        if (!orders(u) || use.access == (writing ? Access::read : Access::write)) continue;
        forEachSubresource(use, graph.resources[use.resource],
                           [&](std::uint32_t s) { f(use.resource, base[use.resource] + s); });
      }
    };
    for (const std::uint32_t u : graph.usesOf(p)) {
      if (!orders(u)) continue;
      graph.links.forEachWriter(graph.links.seen[u], [&](std::uint32_t use) {
        add(graph.links.passOf[use], p, graph.uses[u].resource, Dependency::Type::read_after_write);
      });
    }
    eachCell(true, [&](std::uint32_t r, std::uint32_t cell) {
      add(writer[cell], p, r, Dependency::Type::write_after_write);
      for (const std::uint32_t reader : readers[cell]) add(reader, p, r, Dependency::Type::write_after_read);
    });
    eachCell(false, [&](std::uint32_t, std::uint32_t cell) {
      if (readers[cell].empty() || readers[cell].back() != p) readers[cell].push_back(p);
    });
    eachCell(true, [&](std::uint32_t, std::uint32_t cell) {
      writer[cell] = p;
      readers[cell].clear();
    });
    std::sort(edges.begin() + block, edges.end());
    edges.erase(std::unique(edges.begin() + block, edges.end()), edges.end());
  }
  return edges;
}

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
