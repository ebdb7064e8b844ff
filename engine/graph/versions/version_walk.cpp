#include "engine/graph/versions/version_walk.h"

#include <algorithm>
#include <cassert>

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

}  // namespace weft::graph
