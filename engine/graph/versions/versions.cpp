#include "engine/graph/versions/versions.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace weft::graph {

void VersionWalk::reserve() {
  VersionLinks& links = graph_.links;
  assert(graph_.uses.size() < VersionLinks::kRuns);
  links.passOf.resize(graph_.uses.size(), kNone);
  links.seen.resize(graph_.uses.size(), kNone);
  latest_.resize(graph_.resources.size(), kNone);
}

void VersionWalk::writePart(std::uint32_t use) {
  const FlatUse& flat = graph_.uses[use];
  if (latest_[flat.resource] != kSplit) split(flat.resource);
  std::uint32_t* const cells = cells_.data() + firstCell_[flat.resource];
  forEachSubresource(flat, graph_.resources[flat.resource], [&](std::uint32_t s) { cells[s] = use; });
}

void VersionWalk::split(std::uint32_t resource) {
  if (firstCell_.size() < latest_.size()) firstCell_.resize(latest_.size(), kNone);
  const std::uint32_t count = subresourceCount(graph_.resources[resource]);
  std::uint32_t& first = firstCell_[resource];
  if (first == kNone) {
    first = static_cast<std::uint32_t>(cells_.size());
    cells_.resize(cells_.size() + count);
  }
  std::fill_n(cells_.begin() + first, count, latest_[resource]);
  latest_[resource] = kSplit;
}

void VersionWalk::replace(std::uint32_t last, std::uint32_t next) {
  if (last >= firstCell_.size() || firstCell_[last] == kNone) return;
  if (firstCell_.size() <= next) firstCell_.resize(next + 1, kNone);
  firstCell_[next] = firstCell_[last];
  firstCell_[last] = kNone;
  latest_[last] = kNone;
}

std::uint32_t VersionWalk::linkRuns(const FlatUse& use) {
  std::vector<VersionRun>& runs = graph_.links.runs;
  const auto at = static_cast<std::uint32_t>(runs.size());
  forEachRun(use, [&](std::uint32_t writer, std::uint32_t, std::uint32_t count) {
    runs.push_back({writer, count, 0});
    return true;
  });
  if (runs.size() > at + 1) {
    runs.back().last = 1;
    return VersionLinks::kRuns | at;
  }
  const std::uint32_t only = runs.back().writer;
  runs.pop_back();
  return only;
}

void VersionWalk::finish() {
  VersionLinks& links = graph_.links;
  for (const std::uint32_t use : histories_) {
    links.seen[use] = link(graph_.uses[use]);
    links.forEachWriter(links.seen[use], [&](std::uint32_t writer) {
      links.forward = links.forward || links.passOf[writer] >= links.passOf[use];
    });
  }
  if (graph_.present.resource != kNone) links.present = link(graph_.present);
  for (const FlatUse& output : graph_.outputs) links.outputs.push_back(link(output));
}

void linkVersions(FlatGraph& graph) {
  graph.links = {};
  VersionWalk walk(graph);
  walk.reserve();
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) {
    const FlatPass& pass = graph.passes[p];
    const std::uint32_t end = pass.firstUse + pass.useCount;
    for (std::uint32_t u = pass.firstUse; u < end; ++u) walk.see(u, p);
    for (std::uint32_t u = pass.firstUse; u < end; ++u)
      if (graph.uses[u].access != Access::read) walk.write(u);
  }
  walk.finish();
}

// ---- what is alive ----

namespace {

// Where every link leads back: one backward sweep over the uses, without a branch on what they are. A worklist takes a third more of compile()'s time.
void sweepBack(const FlatGraph& graph, std::uint8_t* const livePass, std::uint8_t* const liveUse) {
  const VersionLinks& links = graph.links;
  const std::uint32_t* const passOf = links.passOf.data();
  for (std::size_t u = graph.uses.size(); u-- > 0;) {
    const FlatUse& use = graph.uses[u];
    const auto stays = static_cast<std::uint8_t>((use.access == Access::read ? 1 : 0) | (use.keep ? 1 : 0));
    const std::uint8_t live = livePass[passOf[u]] & (liveUse[u] | stays);
    const std::uint32_t link = links.seen[u];
    if (VersionLinks::hasRuns(link)) {
      liveUse[u] = live;
      if (live == 0) continue;
      links.forEachWriter(link,
                          [&](std::uint32_t writer) { liveUse[writer] = livePass[passOf[writer]] = 1; });
      continue;
    }
    // A use without a writer takes its own place: what it says of its pass is said already, of itself below.
    const std::size_t writer = link == kNone ? u : link;
    liveUse[writer] |= live;
    livePass[passOf[writer]] |= live;
    liveUse[u] = live;
  }
}

}  // namespace

Liveness findLive(const FlatGraph& graph) {
  const VersionLinks& links = graph.links;
  assert(links.seen.size() == graph.uses.size());  // linkVersions was forgotten
  Liveness live;
  live.pass.assign(graph.passes.size(), 0);
  live.use.assign(graph.uses.size(), 0);
  const auto keep = [&](std::uint32_t use) { live.use[use] = live.pass[links.passOf[use]] = 1; };
  links.forEachWriter(links.present, keep);
  for (const std::uint32_t output : links.outputs) links.forEachWriter(output, keep);
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
    if (graph.passes[p].sideEffect) live.pass[p] = 1;
  sweepBack(graph, live.pass.data(), live.use.data());
  // A read of an earlier frame may lead forward, to a pass that was swept already.
  for (Liveness before; links.forward && (before.pass != live.pass || before.use != live.use);) {
    before = live;
    sweepBack(graph, live.pass.data(), live.use.data());
  }
  return live;
}

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
  // A time-sliced group takes in who writes what it writes, the `on_change` passes whose results it reads, and other
  // time-sliced groups that read an import it reads, until nothing is left to join.
  std::vector<std::uint32_t> maker(graph.resources.size(), kNone);  // a pass; of an import, one that reads it
  for (const std::uint32_t p : members)
    if (graph.passes[p].cadence == Cadence::on_change)
      eachWrite(p, [&](const FlatUse& use) { maker[use.resource] = p; });
  for (bool changed = true; changed;) {
    changed = false;
    for (const std::uint32_t p : members)
      eachWrite(p, [&](const FlatUse& use) {
        if (joint[use.resource] != 0) join(firstWriter[use.resource], p);
      });
    std::vector<std::uint8_t> slicedRoot(graph.passes.size(), 0);
    for (const std::uint32_t p : members)
      if (graph.passes[p].slices > 1) slicedRoot[rootOf(parents, p)] = 1;
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
