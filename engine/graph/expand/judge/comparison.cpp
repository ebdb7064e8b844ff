// Finds what `as compare` means where the reference names no comparison. Declared in judge.h.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/graph/expand/judge/judge.h"
#include "graph_sentences.h"

namespace weft::graph::expansion {

namespace {

// Whether it says which of two surfaces wins, and so which way a lookup has to ask.
bool isOrder(Compare compare) {
  return compare == Compare::less || compare == Compare::less_equal || compare == Compare::greater ||
         compare == Compare::greater_equal;
}

// Finds the depth tests that made what a read sees; `always` for what was made without an order.
struct DepthTests {
  const FlatGraph& graph;
  std::set<Compare> found{};
  std::set<std::uint32_t> seen{};

  void add(std::uint32_t link) {
    graph.links.forEachWriter(link, [&](std::uint32_t writer) {
      if (!seen.insert(writer).second) return;
      const std::uint32_t pass = graph.links.passOf[writer];
      const StateSpec& state = graph.specs[pass].state;
      const FlatUse& use = graph.uses[writer];
      if (use.kind == Kind::depth && state.depthTest && isOrder(state.depthCompare)) {
        found.insert(state.depthCompare);
      } else if (use.kind == Kind::copy) {  // it is what was copied
        for (const std::uint32_t u : graph.usesOf(pass))
          if (graph.uses[u].access == Access::read) add(graph.links.seen[u]);
      } else if (use.access == Access::modify) {
        add(graph.links.seen[writer]);
      } else {
        found.insert(Compare::always);
      }
    });
  }
};

void inferComparison(Model& model, std::uint32_t pass, SlotSpec& slot) {
  const FlatGraph& graph = model.graph;
  DepthTests tests{graph};
  for (std::uint32_t u = slot.firstUse; u < slot.firstUse + slot.useCount; ++u)
    tests.add(graph.links.seen[u]);
  const std::uint32_t resource = graph.uses[slot.firstUse].resource;
  const auto clear = std::ranges::find(graph.clears, resource, &ClearSpec::resource);
  // Nothing was drawn: everything is nearer than what it was cleared to.
  if (tests.found.empty() && clear != graph.clears.end())
    tests.found.insert(clear->value.v[0] > 0.5 ? Compare::less : Compare::greater);
  if (tests.found.size() == 1 && isOrder(*tests.found.begin())) {
    slot.sampler.function = *tests.found.begin();
    return;
  }
  report(model, say::comparisonUnknown, slot.place, graph.passNames[pass], slot.name,
         graph.resourceNames[resource]);
}

}  // namespace

void inferComparisons(Model& model) {
  for (std::uint32_t pass = 0; pass < model.graph.specs.size(); ++pass) {
    const PassSpec& spec = model.graph.specs[pass];
    for (std::uint32_t i = spec.firstSlot; i < spec.firstSlot + spec.slotCount; ++i)
      if (SlotSpec& slot = model.graph.slots[i];
          slot.sampler.compare && !slot.sampler.function && slot.useCount > 0)
        inferComparison(model, pass, slot);
  }
}

}  // namespace weft::graph::expansion
