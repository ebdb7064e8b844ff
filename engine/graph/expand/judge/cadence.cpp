// Passes whose "update" or "slices" do not fit what they read. What shaders do is not looked at: a pass that runs in every
// frame counts as one that writes something new in each. Declared in judge.h.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "engine/graph/expand/judge/judge.h"
#include "engine/graph/versions/versions.h"
#include "graph_sentences.h"

namespace weft::graph::expansion {

namespace {

// A read by which a pass cannot run as its "update" says.
struct Mistiming {
  std::uint32_t pass = kNone, use = kNone;
  std::string why, hint;
};

// Whatever has changed: in each frame, or in each n-th.
bool runsByClock(const FlatPass& pass) {
  return pass.cadence == Cadence::always || pass.cadence == Cadence::every;
}

// What is wrong with one read of a pass that is not `always`; `why` is empty when nothing is.
Mistiming findMistiming(const FlatGraph& graph, std::uint32_t pass, std::uint32_t use) {
  const FlatUse& read = graph.uses[use];
  const std::string& declared = graph.specs[pass].declared;
  const bool once = graph.passes[pass].cadence == Cadence::once;
  Mistiming found{pass, use, "",
                  fmt::format("leave \"update\" out of '{}' to run it in every frame", declared)};
  const std::uint32_t import = graph.resources[read.resource].import;
  if (import != kNone && once && graph.imports[import].changing) {
    found.why = ", which changes while the graph runs: it keeps what was there first";
    found.hint = fmt::format("make '{}' \"update\": \"on_change\"", declared);
  }
  if (import != kNone) return found;
  if (once && read.history > 0) {
    found.why = ": nothing is there in the first frame but its first value";
    return found;
  }
  std::uint32_t always = kNone;
  graph.links.forEachWriter(graph.links.seen[use], [&](std::uint32_t writer) {
    const std::uint32_t by = graph.links.passOf[writer];
    if (graph.passes[by].cadence == Cadence::always) always = by;
    if (by == pass && read.history > 0) found.why = ", which each run of it changes";
  });
  if (always == kNone) return found;
  found.why = fmt::format(", which pass '{}' writes anew in every frame", graph.passNames[always]);
  found.hint += fmt::format(", or, if '{}' always writes the same, make that \"update\": \"once\"",
                            graph.passNames[always]);
  return found;
}

template <class... Args>
void fail(Model& model, std::uint32_t pass, std::uint32_t resource, text::Saying<Args...> what,
          Args&&... args) {
  const FlatGraph& graph = model.graph;
  auto& d = model.diagnostics.error<Args...>(what, graph.specs[pass].place, std::forward<Args>(args)...);
  d.resource = graph.resourceNames[resource];
  d.pass = graph.passNames[pass];
}

// Follows what `group` writes through passes that are not of it: where it comes back to the group, neither could ever end.
void checkWayBack(Model& model, const Groups& groups, std::uint32_t group) {
  const FlatGraph& graph = model.graph;
  std::vector<std::uint32_t> from(graph.resources.size(), kNone);  // the pass outside that last touched it
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) {
    const bool inside = groups.groupOf(p) == group;
    bool follows = false;
    for (const std::uint32_t u : graph.usesOf(p)) {
      const FlatUse& use = graph.uses[u];
      if (use.access != Access::read || use.history > 0) continue;
      std::uint32_t& between = from[use.resource];
      follows |= groups.slicedWriterOf(use.resource) == group || between != kNone;
      if (!inside || between == kNone) continue;
      fail(model, between, use.resource, say::betweenSlices, graph.passNames[between], graph.passNames[p]);
      between = kNone;
    }
    if (inside || !follows || runsByClock(graph.passes[p])) continue;
    for (const std::uint32_t u : graph.usesOf(p))
      if (graph.uses[u].access != Access::read) from[graph.uses[u].resource] = p;
  }
}

}  // namespace

void checkSlices(Model& model) {
  const FlatGraph& graph = model.graph;
  if (std::ranges::none_of(graph.passes, [](const FlatPass& pass) { return pass.slices > 1; })) return;
  const Groups groups = formGroups(graph, {std::vector<std::uint8_t>(graph.passes.size(), 1),
                                           std::vector<std::uint8_t>(graph.uses.size(), 1)});
  std::vector<std::uint32_t> alwaysWriter(graph.resources.size(), kNone);
  const auto eachUse = [&](auto&& f) {
    for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
      for (const std::uint32_t u : graph.usesOf(p))
        f(p, graph.uses[u], groups.slicedWriterOf(graph.uses[u].resource) != kNone);
  };
  eachUse([&](std::uint32_t p, const FlatUse& use, bool sliced) {
    if (!runsByClock(graph.passes[p]) || use.access == Access::read) return;
    alwaysWriter[use.resource] = p;
    if (sliced)
      fail(model, p, use.resource, say::clockedWritesSliced, graph.passNames[p],
           graph.resourceNames[use.resource]);
  });
  eachUse([&](std::uint32_t p, const FlatUse& use, bool sliced) {
    const std::uint32_t group = groups.groupOf(p), writer = alwaysWriter[use.resource];
    if (group == kNone || groups.sliced[group] == 0 || use.access != Access::read || use.history > 0 ||
        writer == kNone || sliced)
      return;
    fail(model, p, use.resource, say::slicedReadsClocked, graph.passNames[p],
         graph.resourceNames[use.resource], graph.passNames[writer]);
  });
  for (std::uint32_t group = 0; group < groups.sliced.size(); ++group)
    if (groups.sliced[group] != 0) checkWayBack(model, groups, group);
}

void warnCadence(Model& model) {
  const FlatGraph& graph = model.graph;
  std::vector<Mistiming> suspects;
  std::set<std::uint32_t> changing;  // what `on_change` passes write
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) {
    const Cadence cadence = graph.passes[p].cadence;
    for (const std::uint32_t u : graph.usesOf(p)) {
      if (cadence == Cadence::on_change && graph.uses[u].access != Access::read)
        changing.insert(graph.uses[u].resource);
      if (runsByClock(graph.passes[p]) || graph.uses[u].access != Access::read) continue;
      if (Mistiming found = findMistiming(graph, p, u); !found.why.empty())
        suspects.push_back(std::move(found));
    }
  }
  if (suspects.empty()) return;
  const Liveness live = findLive(graph);
  for (const Mistiming& found : suspects) {
    const PassSpec& spec = graph.specs[found.pass];
    const bool once = graph.passes[found.pass].cadence == Cadence::once;
    const bool again =
        once && std::ranges::any_of(graph.usesOf(found.pass), [&](std::uint32_t u) {
          return graph.uses[u].access != Access::read && changing.contains(graph.uses[u].resource);
        });
    if (live.pass[found.pass] == 0 || again) continue;
    const FlatUse& read = graph.uses[found.use];
    std::string name = graph.resourceNames[read.resource];
    if (read.history > 0) name += fmt::format("@-{}", read.history);
    warn(model, say::cadenceMisfit, spec.place, spec.name,
         once ? "once" : "in every frame, though it says \"on_change\"", name, found.why, found.hint);
  }
}

}  // namespace weft::graph::expansion
