// Passes whose "update" or "slices" do not fit what they read. What shaders do is not looked at: a pass that runs in every
// frame counts as one that writes something new in each. Declared in judge.h.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "engine/graph/expand/judge/judge.h"
#include "engine/graph/versions/groups.h"
#include "engine/graph/versions/live.h"

namespace weft::graph::expansion {

namespace {

// Why the cadence of a pass does not fit one of its reads.
struct Mistiming {
  enum class Why : std::uint8_t { none, history, ownHistory, everyFrame, changingImport } why = Why::none;
  std::uint32_t use = kNone;
  std::uint32_t writer = kNone;  // the pass that writes it in every frame
};

Mistiming findMistiming(const FlatGraph& graph, std::uint32_t pass, std::uint32_t use) {
  using enum Mistiming::Why;
  const FlatUse& read = graph.uses[use];
  const bool once = graph.passes[pass].cadence == Cadence::once;
  if (const std::uint32_t import = graph.resources[read.resource].import; import != kNone)
    return {once && graph.imports[import].changing ? changingImport : none, use};
  if (once && read.history > 0) return {history, use};
  Mistiming found;
  graph.links.forEachWriter(graph.links.seen[use], [&](std::uint32_t writer) {
    const std::uint32_t by = graph.links.passOf[writer];
    if (graph.passes[by].cadence == Cadence::always)
      found = {everyFrame, use, by};
    else if (by == pass && read.history > 0 && found.why == none)
      found = {ownHistory, use};
  });
  return found;
}

void warnOfMistiming(Model& model, std::uint32_t pass, const Mistiming& found) {
  using enum Mistiming::Why;
  const FlatGraph& graph = model.graph;
  const PassSpec& spec = graph.specs[pass];
  const FlatUse& read = graph.uses[found.use];
  const std::string& resource = graph.resourceNames[read.resource];
  const std::string name = read.history > 0 ? fmt::format("{}@-{}", resource, read.history) : resource;
  const std::string writer = found.writer == kNone ? "" : graph.passNames[found.writer];
  const bool once = graph.passes[pass].cadence == Cadence::once;
  const std::string why = found.why == history ? ": nothing is there in the first frame but its first value"
                          : found.why == ownHistory ? ", which each run of it changes"
                          : found.why == everyFrame
                              ? fmt::format(", which pass '{}' writes anew in every frame", writer)
                              : ", which changes while the graph runs: it keeps what was there first";
  auto& d = model.diagnostics.warning(
      Code::cadenceMisfit, spec.place,
      fmt::format("pass '{}' runs {}: it reads '{}'{}", spec.name,
                  once ? "once" : "in every frame, though it says \"on_change\"", name, why));
  d.pass = spec.name;
  d.resource = name;
  d.hint = found.why == changingImport
               ? fmt::format("make '{}' \"update\": \"on_change\"", spec.declared)
               : fmt::format("leave \"update\" out of '{}' to run it in every frame", spec.declared);
  if (found.why == everyFrame)
    d.hint += fmt::format(", or, if '{}' always writes the same, make that \"update\": \"once\"", writer);
}

// The `once` passes that may run again, with an `on_change` pass that writes the same.
std::set<std::uint32_t> findReruns(const FlatGraph& graph) {
  std::set<std::uint32_t> changing, reruns;  // resources, passes
  const auto eachWrite = [&](Cadence cadence, auto&& f) {
    for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
      if (graph.passes[p].cadence == cadence)
        for (const std::uint32_t u : graph.usesOf(p))
          if (graph.uses[u].access != Access::read) f(p, graph.uses[u].resource);
  };
  eachWrite(Cadence::on_change, [&](std::uint32_t, std::uint32_t resource) { changing.insert(resource); });
  eachWrite(Cadence::once, [&](std::uint32_t pass, std::uint32_t resource) {
    if (changing.contains(resource)) reruns.insert(pass);
  });
  return reruns;
}

void fail(Model& model, std::uint32_t pass, std::uint32_t resource, std::string message, std::string hint) {
  auto& d = model.diagnostics.error(Code::badSlices, model.graph.specs[pass].place, std::move(message));
  d.pass = model.graph.passNames[pass];
  d.resource = model.graph.resourceNames[resource];
  d.hint = std::move(hint);
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
      fail(model, between, use.resource,
           fmt::format(
               "pass '{}' stands between slices: it reads what they write and pass '{}' reads what it writes",
               graph.passNames[between], graph.passNames[p]),
           "make it \"update\": \"on_change\"");
      between = kNone;
    }
    if (inside || !follows || graph.passes[p].cadence == Cadence::always) continue;
    for (const std::uint32_t u : graph.usesOf(p))
      if (graph.uses[u].access != Access::read) from[graph.uses[u].resource] = p;
  }
}

}  // namespace

void checkSlices(Model& model) {
  const FlatGraph& graph = model.graph;
  const Groups groups = formGroups(graph, {std::vector<std::uint8_t>(graph.passes.size(), 1),
                                           std::vector<std::uint8_t>(graph.uses.size(), 1)});
  if (groups.ofResource.empty()) return;
  std::vector<std::uint32_t> alwaysWriter(graph.resources.size(), kNone);
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
    for (const std::uint32_t u : graph.usesOf(p)) {
      const FlatUse& use = graph.uses[u];
      if (graph.passes[p].cadence != Cadence::always || use.access == Access::read) continue;
      alwaysWriter[use.resource] = p;
      // W076 says the same of what the pass modifies, unless that is version zero.
      const bool isReported =
          std::ranges::any_of(model.diagnostics.items(), [&](const text::Diagnostic& each) {
            return use.access == Access::modify && each.code == Code::addsUp &&
                   each.pass == graph.passNames[p];
          });
      if (groups.slicedWriterOf(use.resource) != kNone && !isReported)
        fail(model, p, use.resource,
             fmt::format(
                 "pass '{}' runs in every frame and writes '{}', which others write over several frames",
                 graph.passNames[p], graph.resourceNames[use.resource]),
             "write a resource of its own, or remove \"slices\"");
    }
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) {
    const std::uint32_t group = groups.groupOf(p);
    if (group == kNone || groups.sliced[group] == 0) continue;
    for (const std::uint32_t u : graph.usesOf(p)) {
      const FlatUse& use = graph.uses[u];
      const std::uint32_t writer = alwaysWriter[use.resource];
      if (use.access != Access::read || use.history > 0 || writer == kNone ||
          groups.slicedWriterOf(use.resource) != kNone)
        continue;
      fail(model, p, use.resource,
           fmt::format("pass '{}' is time-sliced and reads '{}', which pass '{}' makes anew in each frame",
                       graph.passNames[p], graph.resourceNames[use.resource], graph.passNames[writer]),
           fmt::format("make '{}' \"update\": \"on_change\", or remove \"slices\"", graph.passNames[writer]));
    }
  }
  for (std::uint32_t group = 0; group < groups.sliced.size(); ++group)
    if (groups.sliced[group] != 0) checkWayBack(model, groups, group);
}

void warnCadence(Model& model) {
  const FlatGraph& graph = model.graph;
  std::vector<std::pair<std::uint32_t, Mistiming>> suspects;  // passes
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) {
    if (graph.passes[p].cadence == Cadence::always) continue;
    for (const std::uint32_t u : graph.usesOf(p)) {
      if (graph.uses[u].access != Access::read) continue;
      const Mistiming found = findMistiming(graph, p, u);
      if (found.why == Mistiming::Why::none) continue;
      suspects.emplace_back(p, found);
      break;
    }
  }
  if (suspects.empty()) return;
  const Liveness live = findLive(graph);
  const std::set<std::uint32_t> reruns = findReruns(graph);
  std::set<std::string_view> reported;  // stanzas
  for (const auto& [pass, found] : suspects)
    if (live.pass[pass] != 0 && !reruns.contains(pass) && reported.insert(graph.specs[pass].declared).second)
      warnOfMistiming(model, pass, found);
}

}  // namespace weft::graph::expansion
