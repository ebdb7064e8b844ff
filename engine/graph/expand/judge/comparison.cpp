// Finds what `as compare` means where the reference names no comparison. Declared in judge.h.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/graph/expand/judge/judge.h"

namespace weft::graph::expansion {

namespace {

// Whether it says which of two surfaces wins, and so which way a lookup has to ask.
bool isOrder(Compare compare) {
  return compare == Compare::less || compare == Compare::less_equal || compare == Compare::greater ||
         compare == Compare::greater_equal;
}

// The depth tests that made what a read sees.
struct DepthTests {
  std::set<Compare> found;
  std::uint32_t other = kNone;  // a pass that wrote some of it without an order
  std::set<std::uint32_t> seen{};

  void add(const FlatGraph& graph, std::uint32_t link) {
    graph.links.forEachWriter(link, [&](std::uint32_t writer) {
      if (!seen.insert(writer).second) return;
      const std::uint32_t pass = graph.links.passOf[writer];
      const StateSpec& state = graph.specs[pass].state;
      const FlatUse& use = graph.uses[writer];
      if (use.kind == Kind::depth && state.depthTest && isOrder(state.depthCompare)) {
        found.insert(state.depthCompare);
      } else if (use.kind == Kind::copy) {  // it is what was copied
        for (const std::uint32_t u : graph.usesOf(pass))
          if (graph.uses[u].access == Access::read) add(graph, graph.links.seen[u]);
      } else if (use.access == Access::modify) {
        add(graph, graph.links.seen[writer]);
      } else {
        other = pass;
      }
    });
  }
};

void inferComparison(Model& model, std::uint32_t pass, SlotSpec& slot) {
  const FlatGraph& graph = model.graph;
  DepthTests tests;
  for (std::uint32_t u = slot.firstUse; u < slot.firstUse + slot.useCount; ++u)
    tests.add(graph, graph.links.seen[u]);
  const std::uint32_t resource = graph.uses[slot.firstUse].resource;
  const std::string& name = graph.resourceNames[resource];
  const auto clear = std::ranges::find(graph.clears, resource, &ClearSpec::resource);
  std::string why = "no depth test made it";
  if (tests.other != kNone) {
    why = fmt::format("pass '{}' writes it without one that orders", graph.passNames[tests.other]);
  } else if (tests.found.size() > 1) {
    why = "passes with different depth tests draw it";
  } else if (!tests.found.empty()) {
    slot.sampler.function = *tests.found.begin();
    return;
  } else if (clear !=
             graph.clears.end()) {  // nothing was drawn: everything is nearer than what it was cleared to
    slot.sampler.function = clear->value.v[0] > 0.5 ? Compare::less : Compare::greater;
    return;
  }
  report(
      model, Code::badKind, slot.place,
      fmt::format("pass '{}': slot '{}' compares with '{}', and nothing says how: {}", graph.passNames[pass],
                  slot.name, name, why),
      {.expected = "the comparison that a lookup passes: less, less_equal, greater, greater_equal, …",
       .hint =
           "write 'compare(greater)' where nearer is greater, as in every view here; 'compare(less)' where "
           "nearer is less",
       .resource = name,
       .pass = graph.passNames[pass]});
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
