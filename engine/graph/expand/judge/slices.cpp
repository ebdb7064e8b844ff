// What cannot be time-sliced, reported once all passes are known: W077.
#include "engine/graph/expand/judge/slices.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/graph/versions/groups.h"

namespace weft::graph::expansion {

namespace {

template <class F>
void eachUse(const FlatGraph& graph, std::uint32_t pass, F&& f) {
  const FlatPass& p = graph.passes[pass];
  for (std::uint32_t u = p.firstUse; u < p.firstUse + p.useCount; ++u) f(graph.uses[u]);
}

base::Diagnostic& fail(Model& model, std::uint32_t pass, std::uint32_t resource, std::string message) {
  auto& d = model.diagnostics.error(Code::badSlices, model.graph.specs[pass].place, std::move(message));
  d.pass = model.graph.passNames[pass];
  if (resource != kNone) d.resource = model.graph.resourceNames[resource];
  return d;
}

// W076 says the same of what the pass modifies, unless that is version zero.
bool isReportedAlready(const Model& model, std::uint32_t pass) {
  return std::ranges::any_of(model.diagnostics.items(), [&](const base::Diagnostic& each) {
    return each.code == Code::addsUp && each.pass == model.graph.passNames[pass];
  });
}

// Follows what `group` writes through passes that are not of it: where it comes back to the group, neither could
// ever end.
// Both can only stand between its `first` and its `last` pass. `from`, per resource: the pass outside that last touched
// it; all kNone before and after.
void checkWayBack(Model& model, const Groups& groups, std::uint32_t group, std::uint32_t first,
                  std::uint32_t last, std::vector<std::uint32_t>& from) {
  const FlatGraph& graph = model.graph;
  std::vector<std::uint32_t> touched;
  for (std::uint32_t p = first; p <= last; ++p) {
    if (groups.groupOf(p) == group) {
      eachUse(graph, p, [&](const FlatUse& use) {
        if (use.access != Access::read || use.history > 0 || from[use.resource] == kNone) return;
        const std::uint32_t between = from[use.resource];
        fail(model, between, use.resource,
             fmt::format("pass '{}' stands between slices: it reads what they write and pass '{}' reads what "
                         "it writes",
                         graph.passNames[between], graph.passNames[p]))
            .hint = "give it the same \"group\"";
        from[use.resource] = kNone;
      });
      continue;
    }
    bool reads = false;
    eachUse(graph, p, [&](const FlatUse& use) {
      if (use.access == Access::read && use.history == 0)
        reads |= groups.slicedWriterOf(use.resource) == group || from[use.resource] != kNone;
    });
    if (!reads || graph.passes[p].cadence == Cadence::always) continue;
    eachUse(graph, p, [&](const FlatUse& use) {
      if (use.access == Access::read) return;
      from[use.resource] = p;
      touched.push_back(use.resource);
    });
  }
  for (const std::uint32_t resource : touched) from[resource] = kNone;
}

}  // namespace

void checkSlices(Model& model) {
  const FlatGraph& graph = model.graph;
  const auto every = [](std::uint32_t) { return true; };
  const Groups groups = formGroups(graph, every, every);
  if (groups.ofResource.empty()) return;
  std::vector<std::uint32_t> alwaysWriter(graph.resources.size(), kNone);
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) {
    if (graph.passes[p].cadence != Cadence::always) continue;
    eachUse(graph, p, [&](const FlatUse& use) {
      if (use.access == Access::read) return;
      alwaysWriter[use.resource] = p;
      if (groups.slicedWriterOf(use.resource) == kNone) return;
      if (use.access == Access::modify && isReportedAlready(model, p)) return;
      fail(
          model, p, use.resource,
          fmt::format("pass '{}' runs in every frame and writes '{}', which others write over several frames",
                      graph.passNames[p], graph.resourceNames[use.resource]))
          .hint = "write a resource of its own, or remove \"slices\"";
    });
  }
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) {
    const std::uint32_t group = groups.groupOf(p);
    if (group == kNone || groups.sliced[group] == 0) continue;
    eachUse(graph, p, [&](const FlatUse& use) {
      const std::uint32_t writer =
          use.access == Access::read && use.history == 0 ? alwaysWriter[use.resource] : kNone;
      if (writer == kNone || groups.slicedWriterOf(use.resource) != kNone) return;
      fail(model, p, use.resource,
           fmt::format("pass '{}' is time-sliced and reads '{}', which pass '{}' makes anew in each",
                       graph.passNames[p], graph.resourceNames[use.resource], graph.passNames[writer]))
          .hint =
          fmt::format("make '{}' \"update\": \"on_change\", or remove \"slices\"", graph.passNames[writer]);
    });
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> rangeOf(groups.sliced.size(), {kNone, 0});
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
    if (const std::uint32_t group = groups.groupOf(p); group != kNone) {
      rangeOf[group].first = std::min(rangeOf[group].first, p);
      rangeOf[group].second = p;
    }
  std::vector<std::uint32_t> from(graph.resources.size(), kNone);
  for (std::uint32_t group = 0; group < groups.sliced.size(); ++group)
    if (const auto [first, last] = rangeOf[group]; groups.sliced[group] != 0 && first < last)
      checkWayBack(model, groups, group, first, last, from);
}

}  // namespace weft::graph::expansion
