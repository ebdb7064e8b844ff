#include "engine/graph/versions/groups.h"

#include <algorithm>
#include <utility>

namespace weft::graph {

namespace {

std::uint32_t rootOf(std::vector<std::uint32_t>& parents, std::uint32_t i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}

}  // namespace

Groups formGroups(const FlatGraph& graph, const Liveness& live) {
  Groups groups;
  std::vector<std::uint32_t> members;  // live passes that are not always
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
    if (graph.passes[p].cadence != Cadence::always && live.pass[p] != 0) members.push_back(p);
  if (members.empty()) return groups;

  std::vector<std::uint8_t> joint(graph.resources.size(), 0);
  for (std::size_t r = 0; r < joint.size(); ++r) joint[r] = graph.resources[r].history > 0;
  const auto eachWrite = [&](std::uint32_t p, auto&& visit) {
    for (const std::uint32_t u : graph.usesOf(p))
      if (graph.uses[u].access != Access::read && live.use[u] != 0) visit(graph.uses[u]);
  };
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) {
    const FlatPass& pass = graph.passes[p];
    if (live.pass[p] == 0) continue;
    const bool together = pass.cadence != Cadence::always && pass.slices != 1;
    eachWrite(p, [&](const FlatUse& use) {
      if (use.access == Access::modify || together) joint[use.resource] = 1;
    });
  }
  std::vector<std::uint32_t> parents(graph.passes.size());
  for (std::uint32_t p = 0; p < parents.size(); ++p) parents[p] = p;
  std::vector<std::uint32_t> firstWriter(graph.resources.size(), kNone);
  const auto join = [&](std::uint32_t& first, std::uint32_t p) {
    if (first == kNone) first = p;
    const std::uint32_t a = rootOf(parents, first), b = rootOf(parents, p);
    parents[std::max(a, b)] = std::min(a, b);
    return a != b;
  };
  const auto joinWriters = [&] {
    for (const std::uint32_t p : members)
      eachWrite(p, [&](const FlatUse& use) {
        if (joint[use.resource] != 0) join(firstWriter[use.resource], p);
      });
  };
  joinWriters();
  // A time-sliced group takes in who writes what it writes, the `on_change` passes whose results it reads, and other
  // time-sliced groups that read an import it reads, until nothing is left to join.
  std::vector<std::uint32_t> maker(graph.resources.size(), kNone);  // a pass; of an import, one that reads it
  for (const std::uint32_t p : members)
    if (graph.passes[p].cadence == Cadence::on_change)
      eachWrite(p, [&](const FlatUse& use) { maker[use.resource] = p; });
  const auto sliced = [&](std::uint32_t p) { return graph.passes[p].slices > 1; };
  for (bool changed = std::ranges::any_of(members, sliced); changed;) {
    changed = false;
    std::vector<std::uint8_t> slicedRoot(graph.passes.size(), 0);
    for (const std::uint32_t p : members)
      if (sliced(p)) slicedRoot[rootOf(parents, p)] = 1;
    for (const std::uint32_t p : members) {
      if (slicedRoot[rootOf(parents, p)] == 0) continue;
      for (const std::uint32_t u : graph.usesOf(p)) {
        const FlatUse& use = graph.uses[u];
        const bool imported = graph.resources[use.resource].import != kNone;
        if (use.access == Access::read && use.history == 0 && (imported || maker[use.resource] != kNone))
          changed |= join(maker[use.resource], p);
        if (use.access != Access::read && live.use[u] != 0)
          changed |= std::exchange(joint[use.resource], std::uint8_t{1}) == 0;
      }
    }
    if (changed) joinWriters();
  }

  std::vector<std::uint32_t> size(graph.passes.size(), 0), groupOfRoot(graph.passes.size(), kNone);
  for (const std::uint32_t p : members) ++size[rootOf(parents, p)];
  groups.ofPass.assign(graph.passes.size(), kNone);
  for (const std::uint32_t p : members) {
    const std::uint32_t root = rootOf(parents, p);
    if (size[root] < 2 && graph.passes[p].slices < 2) continue;
    if (groupOfRoot[root] == kNone) {
      groupOfRoot[root] = static_cast<std::uint32_t>(groups.sliced.size());
      groups.sliced.push_back(0);
    }
    groups.ofPass[p] = groupOfRoot[root];
    if (graph.passes[p].slices > 1) groups.sliced[groups.ofPass[p]] = 1;
  }
  if (std::ranges::find(groups.sliced, std::uint8_t{1}) == groups.sliced.end()) return groups;
  groups.ofResource.assign(graph.resources.size(), kNone);
  for (const std::uint32_t p : members) {
    const std::uint32_t group = groups.ofPass[p];
    if (group == kNone || groups.sliced[group] == 0) continue;
    eachWrite(p, [&](const FlatUse& use) { groups.ofResource[use.resource] = group; });
  }
  return groups;
}

}  // namespace weft::graph
