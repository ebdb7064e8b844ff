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

// False after an error.
bool inferComparison(Model& model, std::uint32_t pass, SlotSpec& slot) {
  const FlatGraph& graph = model.graph;
  DepthTests tests;
  for (std::uint32_t u = slot.firstUse; u < slot.firstUse + slot.useCount; ++u)
    tests.add(graph, graph.links.seen[u]);
  const std::uint32_t resource = graph.uses[slot.firstUse].resource;
  if (tests.other == kNone && tests.found.size() == 1) {
    slot.sampler.function = *tests.found.begin();
    return true;
  }
  if (tests.other == kNone && tests.found.empty() && graph.resources[resource].hasClear) {
    // Nothing was drawn into it: everything is nearer than what it was cleared to.
    const auto clear = std::ranges::find(graph.clears, resource, &ClearSpec::resource);
    const bool far = clear != graph.clears.end() && clear->value.v[0] > 0.5;
    slot.sampler.function = far ? Compare::less : Compare::greater;
    return true;
  }
  const std::string why = tests.found.size() > 1 ? "passes with different depth tests draw it"
                          : tests.other != kNone ? fmt::format("pass '{}' writes it without one that orders",
                                                               graph.passNames[tests.other])
                                                 : "no depth test made it";
  const std::string& name = graph.resourceNames[resource];
  auto& d =
      model.diagnostics.error(Code::badKind, slot.place,
                              fmt::format("pass '{}': slot '{}' compares with '{}', and nothing says how: {}",
                                          graph.passNames[pass], slot.name, name, why));
  d.pass = graph.passNames[pass];
  d.resource = name;
  d.expected = "the comparison that a lookup passes: less, less_equal, greater, greater_equal, …";
  d.hint =
      "write 'compare(greater)' where nearer is greater, as in every view here; 'compare(less)' where nearer "
      "is less";
  return false;
}

}  // namespace

void inferComparisons(Model& model) {
  FlatGraph& graph = model.graph;
  std::set<std::string_view> reported;  // stanzas: the other repeats say the same
  for (std::uint32_t pass = 0; pass < graph.specs.size(); ++pass) {
    const PassSpec& spec = graph.specs[pass];
    for (std::uint32_t i = spec.firstSlot; i < spec.firstSlot + spec.slotCount; ++i) {
      SlotSpec& slot = graph.slots[i];
      if (!slot.sampler.compare || slot.sampler.function || slot.useCount == 0) continue;
      if (!reported.contains(spec.declared) && !inferComparison(model, pass, slot))
        reported.insert(spec.declared);
    }
  }
}

}  // namespace weft::graph::expansion
