// What cannot be time-sliced: W077. Declared in judge.h.
#include <fmt/format.h>

#include <algorithm>

#include "engine/graph/expand/judge/judge.h"
#include "engine/graph/versions/groups.h"

namespace weft::graph::expansion {

namespace {

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
           "give it the same \"group\"");
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
  const auto every = [](std::uint32_t) { return true; };
  const Groups groups = formGroups(graph, every, every);
  if (groups.ofResource.empty()) return;
  std::vector<std::uint32_t> alwaysWriter(graph.resources.size(), kNone);
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
    for (const std::uint32_t u : graph.usesOf(p)) {
      const FlatUse& use = graph.uses[u];
      if (graph.passes[p].cadence != Cadence::always || use.access == Access::read) continue;
      alwaysWriter[use.resource] = p;
      // W076 says the same of what the pass modifies, unless that is version zero.
      const bool isReported =
          std::ranges::any_of(model.diagnostics.items(), [&](const base::Diagnostic& each) {
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

}  // namespace weft::graph::expansion
