#include "engine/graph/expand/judge/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace weft::graph::expansion {

namespace {

// Whether it says which of two surfaces wins, and so which way a lookup has to ask.
bool isOrder(Compare compare) {
  return compare == Compare::less || compare == Compare::less_equal || compare == Compare::greater ||
         compare == Compare::greater_equal;
}

// Follows a read back to the tests that made what it sees.
class Makers {
 public:
  explicit Makers(const FlatGraph& graph) : graph_(graph) {}

  void follow(std::uint32_t link) {
    graph_.links.forEachRun(link, [&](std::uint32_t writer, std::uint32_t) {
      if (writer == kNone)
        cleared = true;
      else if (seen_.insert(writer).second)
        judge(writer);
    });
  }

  std::set<Compare> found;
  bool cleared = false;         // some of it is what "clear" says
  std::uint32_t other = kNone;  // a pass that wrote some of it without an order

 private:
  void judge(std::uint32_t writer) {
    const std::uint32_t pass = graph_.links.passOf[writer];
    const StateSpec& state = graph_.specs[pass].state;
    const FlatUse& use = graph_.uses[writer];
    if (use.kind == Kind::depth && state.depthTest && isOrder(state.depthCompare)) {
      found.insert(state.depthCompare);
    } else if (use.kind == Kind::copy) {  // it is what was copied
      const FlatPass& copy = graph_.passes[pass];
      for (std::uint32_t u = copy.firstUse; u < copy.firstUse + copy.useCount; ++u)
        if (graph_.uses[u].access == Access::read) follow(graph_.links.seen[u]);
    } else if (use.access == Access::modify) {
      follow(graph_.links.seen[writer]);
    } else {
      other = pass;
    }
  }

  const FlatGraph& graph_;
  std::set<std::uint32_t> seen_;
};

// Nothing was drawn into it: everything is nearer than what it was cleared to.
Compare comparisonOfClear(const FlatGraph& graph, std::uint32_t resource) {
  const auto clear = std::ranges::find(graph.clears, resource, &ClearSpec::resource);
  const bool far = clear != graph.clears.end() && clear->value.v[0] > 0.5;
  return far ? Compare::less : Compare::greater;
}

void settle(Model& model, std::uint32_t pass, SlotSpec& slot) {
  FlatGraph& graph = model.graph;
  Makers makers(graph);
  for (std::uint32_t u = slot.firstUse; u < slot.firstUse + slot.useCount; ++u)
    makers.follow(graph.links.seen[u]);
  const std::uint32_t resource = graph.uses[slot.firstUse].resource;
  const std::string& name = graph.resourceNames[resource];
  if (makers.found.size() == 1 && makers.other == kNone) {
    slot.sampler.function = *makers.found.begin();
    return;
  }
  if (makers.found.empty() && makers.other == kNone && graph.resources[resource].hasClear) {
    slot.sampler.function = comparisonOfClear(graph, resource);
    return;
  }
  const std::string why = makers.found.size() > 1 ? "passes with different depth tests draw it"
                          : makers.other != kNone ? fmt::format("pass '{}' writes it without one that orders",
                                                                graph.passNames[makers.other])
                                                  : "no depth test made it";
  auto& d =
      model.diagnostics.error(Code::badKind, slot.place,
                              fmt::format("pass '{}': slot '{}' compares with '{}', and nothing says how: {}",
                                          graph.passNames[pass], slot.name, name, why));
  d.pass = graph.passNames[pass];
  d.resource = name;
  d.expected = "the comparison that a lookup passes: less, less_equal, greater, greater_equal, …";
  d.hint =
      "write 'compare(greater)' where nearer is greater, as in every view here; 'compare(less)' where "
      "nearer is less";
}

}  // namespace

void settleComparisons(Model& model) {
  FlatGraph& graph = model.graph;
  std::set<std::string_view> said;  // stanza and slot: the other repeats say the same
  for (std::uint32_t pass = 0; pass < graph.specs.size(); ++pass) {
    const PassSpec& spec = graph.specs[pass];
    for (std::uint32_t i = spec.firstSlot; i < spec.firstSlot + spec.slotCount; ++i) {
      SlotSpec& slot = graph.slots[i];
      if (!slot.sampler.compare || slot.sampler.function || slot.useCount == 0) continue;
      if (said.contains(spec.declared)) continue;
      const std::size_t before = model.diagnostics.errorCount();
      settle(model, pass, slot);
      if (model.diagnostics.errorCount() > before) said.insert(spec.declared);
    }
  }
}

}  // namespace weft::graph::expansion
