#include "engine/graph/expand/judge/misplaced.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "engine/graph/subresource.h"

namespace weft::graph::expansion {

namespace {

// Whether what a pass makes goes, directly or through others, into what another one makes.
class Needs {
 public:
  explicit Needs(const FlatGraph& graph) : graph_(graph) {}

  bool has(std::uint32_t pass, std::uint32_t earlier) {
    const auto [at, fresh] = needed_.try_emplace(pass);
    std::vector<bool>& needed = at->second;
    if (!fresh) return needed[earlier];
    needed.assign(graph_.passes.size(), false);
    std::vector<std::uint32_t> open{pass};
    needed[pass] = true;
    while (!open.empty()) {
      const FlatPass& flat = graph_.passes[open.back()];
      open.pop_back();
      for (std::uint32_t u = flat.firstUse; u < flat.firstUse + flat.useCount; ++u) {
        // What is drawn over needs nothing of what is there.
        if (graph_.uses[u].access == Access::modify && !isStore(graph_.uses[u])) continue;
        graph_.links.forEachWriter(graph_.links.seen[u], [&](std::uint32_t writer) {
          const std::uint32_t next = graph_.links.passOf[writer];
          if (needed[next]) return;
          needed[next] = true;
          open.push_back(next);
        });
      }
    }
    return needed[earlier];
  }

 private:
  const FlatGraph& graph_;
  std::map<std::uint32_t, std::vector<bool>> needed_;
};

}  // namespace

std::vector<Missed> missedReads(const Model& model, const Ground& ground) {
  std::vector<Missed> missed;
  for (const WouldUse& would : model.would) {
    if (would.why == WouldUse::Why::off || would.entity == kNone || would.slot == kNone) continue;
    const auto at = std::ranges::lower_bound(model.positionOf, would.position);
    if (at == model.positionOf.end() || *at != would.position) continue;  // of a disabled pass
    const auto pass = static_cast<std::uint32_t>(at - model.positionOf.begin());
    ground.eachElement(would.entity, would.firstElement, would.elementCount, would.rect,
                       [&](const FlatUse& use) {
                         missed.push_back({&would, {would.position, use, pass}});
                       });
  }
  return missed;
}

std::pair<std::string, std::string> entriesOf(const std::string& a, const std::string& b) {
  std::size_t from = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()) && a[i] == b[i]; ++i)
    if (a[i] == '.') from = i + 1;
  return {a.substr(0, a.find('.', from)), b.substr(0, b.find('.', from))};
}

void warnMisplaced(Model& model, const Ground& ground, const Liveness& live,
                   const std::function<bool(std::uint32_t)>& isLost) {
  const FlatGraph& graph = model.graph;
  const std::vector<Missed> missed = missedReads(model, ground);
  if (missed.empty()) return;
  std::vector<Line> queries, marks;
  for (const Missed& each : missed) queries.push_back(each.line);
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) {
    if (isLost(p)) continue;
    const FlatPass& flat = graph.passes[p];
    for (std::uint32_t u = flat.firstUse; u < flat.firstUse + flat.useCount; ++u) {
      Line line{model.positionOf[p], graph.uses[u], p};
      line.use.resource = ground.of(line.use.resource);
      if (graph.uses[u].access != Access::read && line.use.resource != kNone) marks.push_back(line);
    }
  }
  const std::vector<std::uint32_t> writers = findNearest(ground, queries, marks, true);
  // Where a pass above is switched off, what it would write is what is missing.
  std::vector<Line> off;
  for (const WriteRecord& write : model.writes)
    if (write.pass == kNone)
      ground.eachElement(write.entity, write.firstElement, write.elementCount, write.rect,
                         [&](const FlatUse& use) {
                           off.push_back({write.position, use, 0});
                         });
  for (const WouldUse& would : model.would)
    if (would.entity != kNone && would.rect.access != Access::read)
      ground.eachElement(would.entity, would.firstElement, would.elementCount, would.rect,
                         [&](const FlatUse& use) {
                           off.push_back({would.position, use, 0});
                         });
  const std::vector<std::uint32_t> switchedOff = findNearest(ground, queries, off, false);
  Needs needs(graph);
  std::set<std::pair<std::string_view, std::string_view>> said;  // stanza and slot
  for (std::size_t i = 0; i < missed.size(); ++i) {
    const std::uint32_t writer = writers[i], reader = queries[i].who;
    const WouldUse& would = *missed[i].would;
    if (writer == kNone || live.pass[reader] == 0 || switchedOff[i] != kNone) continue;
    const PassSpec &spec = graph.specs[reader], &other = graph.specs[writer];
    if (spec.declared == other.declared) continue;
    if (would.why == WouldUse::Why::zero && needs.has(writer, reader)) continue;
    const SlotSpec& slot = graph.slots[spec.firstSlot + would.slot];
    if (!said.emplace(spec.declared, slot.name).second) continue;
    const std::string& resource = model.entities[would.entity].name;
    auto& d = model.diagnostics.warning(
        Code::readBeforeWrite, slot.place,
        fmt::format("pass '{}' reads '{}' before pass '{}' writes it: its slot '{}' {}", spec.name, resource,
                    other.name, slot.name,
                    would.why == WouldUse::Why::zero ? "has only what \"clear\" says"
                    : slot.useCount == 0             ? "stays empty"
                                                     : "takes another alternative"));
    d.pass = spec.name;
    d.resource = resource;
    const auto [here, there] = entriesOf(spec.declared, other.declared);
    d.hint = fmt::format("move '{}' above '{}', or read '{}@-1' for what it was in the frame before", there,
                         here, resource);
  }
}

}  // namespace weft::graph::expansion
