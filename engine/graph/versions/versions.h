// The one walk of versions, and what is alive by it. It visits passes in declared order, keeps which use wrote each sub-resource last,
// and makes FlatGraph::links of that. Expansion moves it on use by use, because which version a write makes depends on what was
// read; linkVersions runs it over a whole graph. The time is linear in the uses, and in the sub-resources of uses that touch a
// resource in part or after such a write.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/graph/plan.h"
#include "engine/graph/subresource.h"

namespace weft::graph {

class VersionWalk {
 public:
  // Uses and resources are added to `graph` as the walk goes on; it outlives the walk.
  explicit VersionWalk(FlatGraph& graph) : graph_(graph) {}

  // Memory for the uses and resources that `graph` has by now; it grows by itself, too.
  void reserve();

  // A use of `pass`. Of one pass all uses are seen before one of them is written; one that is not valid is never seen.
  void see(std::uint32_t use, std::uint32_t pass) {
    VersionLinks& links = graph_.links;
    if (use >= links.seen.size()) reserve();
    const FlatUse& flat = graph_.uses[use];
    links.passOf[use] = pass;
    if (flat.history > 0)
      histories_.push_back(use);
    else if (flat.access != Access::write)
      links.seen[use] = link(flat);
  }
  // `use`, seen before, is now the version of its sub-resources.
  void write(std::uint32_t use) {
    const FlatUse& flat = graph_.uses[use];
    if (flat.resource >= latest_.size()) reserve();
    if (isWhole(flat, graph_.resources[flat.resource]))
      latest_[flat.resource] = use;
    else
      writePart(use);
  }
  // `next`, which nobody wrote yet, takes the place of `last`, which is of the same shape and is not used any more: it takes over its memory.
  void replace(std::uint32_t last, std::uint32_t next);
  // After the last pass: reads of earlier frames, present and outputs. The resources of all uses are known by then.
  void finish();

  // True when some sub-resource of it was written.
  bool isWritten(std::uint32_t resource) const {
    return resource < latest_.size() && latest_[resource] != kNone;
  }
  // Calls f(writer, first, count) for each run of sub-resources of `use` with one writer, kNone for none, until f
  // returns false; `first` is the number of the run's first.
  template <class F>
  void forEachRun(const FlatUse& use, F&& f) const {
    const FlatResource& r = graph_.resources[use.resource];
    std::uint32_t writer = kNone, first = 0, count = 0;
    if (use.resource >= latest_.size() || latest_[use.resource] != kSplit) {
      if (use.resource < latest_.size()) writer = latest_[use.resource];
      forEachSubresource(use, r, [&](std::uint32_t s) {
        first = s;
        return false;
      });
      f(writer, first, subresourceCount(use, r));
      return;
    }
    const std::uint32_t* const cells = cells_.data() + firstCell_[use.resource];
    bool goesOn = true;
    forEachSubresource(use, r, [&](std::uint32_t s) {
      if (count > 0 && cells[s] != writer) {
        goesOn = f(writer, first, count);
        count = 0;
      }
      if (count++ == 0) first = s, writer = cells[s];
      return goesOn;
    });
    if (goesOn) f(writer, first, count);
  }

 private:
  static constexpr std::uint32_t kSplit = kNone - 1;

  std::uint32_t link(const FlatUse& use) {
    const std::uint32_t latest = use.resource < latest_.size() ? latest_[use.resource] : kNone;
    return latest != kSplit ? latest : linkRuns(use);
  }
  std::uint32_t linkRuns(const FlatUse& use);
  void writePart(std::uint32_t use);
  void split(std::uint32_t resource);

  FlatGraph& graph_;
  std::vector<std::uint32_t> latest_;     // per resource: the use that wrote all of it, kNone, or kSplit
  std::vector<std::uint32_t> firstCell_;  // per resource that was ever split: its first cell, else kNone
  std::vector<std::uint32_t> cells_;      // per sub-resource of those: the use that wrote it, or kNone
  std::vector<std::uint32_t> histories_;  // uses that wait for finish()
};

// Fills graph.links. Indices and ranges of the uses must be valid.
void linkVersions(FlatGraph& graph);

// Finds the live passes, and the uses for which they are needed, along FlatGraph::links. There is no other such walk: the
// checks of expansion warn by its result, and compile() culls by it.

// `pass`: 1 for what `present`, an output, a side effect or a history that a live pass reads needs, directly or through
// others. `use`: 1 for all reads of live passes, and for writes and modifies that are kept or that a live use sees.
struct Liveness {
  std::vector<std::uint8_t> pass, use;
};

// Linear in uses and runs, for each link of a chain of histories that leads forward again.
Liveness findLive(const FlatGraph& graph);

// Forms the groups of a graph (struct Groups in plan.h): all writers of a resource that has a history, that some pass
// modifies, or that a time-sliced group writes. A group with a pass in more than one slice is time-sliced: what it writes has
// one more copy, and all of it is published at once. It takes in the `on_change` passes whose results it reads, and the
// time-sliced groups that read an import it reads.

// Of the live passes, by the writes that are live.
Groups formGroups(const FlatGraph& graph, const Liveness& live);

}  // namespace weft::graph
