#include "engine/graph/expand/judge/misplaced.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

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
  // What stands on the wrong side of the same entry is one mistake.
  struct Mistake {
    std::size_t first;
    std::vector<std::string_view> readers{};  // stanzas, the first not among them
  };
  std::map<std::pair<std::string, std::string>, Mistake> mistakes;
  std::vector<std::pair<std::string, std::string>> inOrder;
  for (std::size_t i = 0; i < missed.size(); ++i) {
    const std::uint32_t writer = writers[i], reader = queries[i].who;
    if (writer == kNone || live.pass[reader] == 0 || switchedOff[i] != kNone) continue;
    const std::string &name = graph.specs[reader].declared, &other = graph.specs[writer].declared;
    if (name == other) continue;
    if (missed[i].would->why == WouldUse::Why::zero && needs.has(writer, reader)) continue;
    auto entries = entriesOf(name, other);
    const auto [at, fresh] = mistakes.try_emplace(entries, Mistake{i});
    if (fresh) inOrder.push_back(std::move(entries));
    std::vector<std::string_view>& readers = at->second.readers;
    if (name != graph.specs[queries[at->second.first].who].declared &&
        std::ranges::find(readers, name) == readers.end())
      readers.push_back(name);
  }
  for (const auto& entries : inOrder) {
    const auto& [here, there] = entries;
    const Mistake& mistake = mistakes.at(entries);
    const WouldUse& would = *missed[mistake.first].would;
    const PassSpec& spec = graph.specs[queries[mistake.first].who];
    const SlotSpec& slot = graph.slots[spec.firstSlot + would.slot];
    const std::string& resource = model.entities[would.entity].name;
    std::string message =
        fmt::format("pass '{}' reads '{}' before pass '{}' writes it: its slot '{}' {}", spec.name, resource,
                    graph.specs[writers[mistake.first]].name, slot.name,
                    would.why == WouldUse::Why::zero ? "has only what \"clear\" says"
                    : slot.useCount == 0             ? "stays empty"
                                                     : "takes another alternative");
    if (!mistake.readers.empty())
      message += fmt::format("; likewise '{}'", fmt::join(mistake.readers, "', '"));
    // What is culled of that entry, with what only feeds it.
    std::vector<bool> gone(graph.passes.size(), false);
    for (std::size_t p = graph.passes.size(); p-- > 0;) {
      const std::string& name = graph.specs[p].declared;
      if (live.pass[p] != 0 || isLost(static_cast<std::uint32_t>(p))) continue;
      if (name == there || name.starts_with(there + ".")) gone[p] = true;
      if (!gone[p]) continue;
      const FlatPass& flat = graph.passes[p];
      for (std::uint32_t u = flat.firstUse; u < flat.firstUse + flat.useCount; ++u)
        graph.links.forEachWriter(graph.links.seen[u], [&](std::uint32_t writer) {
          gone[graph.links.passOf[writer]] = live.pass[graph.links.passOf[writer]] == 0;
        });
    }
    std::vector<std::string_view> culled;
    for (std::size_t p = 0; p < gone.size(); ++p)
      if (const std::string& name = graph.specs[p].declared;
          gone[p] && std::ranges::find(culled, name) == culled.end())
        culled.push_back(name);
    if (!culled.empty()) message += fmt::format("; culled: '{}'", fmt::join(culled, "', '"));
    auto& d = model.diagnostics.warning(Code::readBeforeWrite, slot.place, std::move(message));
    d.pass = spec.name;
    d.resource = resource;
    d.hint = fmt::format("move '{}' above '{}', or read '{}@-1' for what it was in the frame before", there,
                         here, resource);
  }
}

}  // namespace weft::graph::expansion
