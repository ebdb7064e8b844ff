// What would live if all that is switched off were there, and who stands nearest to a use in declared order. Both follow
// the one walk of versions.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/graph/expand/names/model.h"
#include "engine/graph/versions/live.h"

namespace weft::graph::expansion {

// A graph in which each texture, buffer and element of an array is one resource, whatever versions it has.
class Ground {
 public:
  explicit Ground(const Model& model);

  // The resource of a FlatResource of the graph; kNone for imports.
  std::uint32_t of(std::uint32_t resource) const { return ofResource_[resource]; }
  // Calls f(use) for what `what`, a WriteRecord or a WouldUse, has of each element.
  template <class What, class F>
  void eachElement(const What& what, F&& f) const {
    if (what.entity == kNone || first_[what.entity] == kNone) return;
    FlatUse use = what.rect;
    for (std::uint32_t e = what.firstElement; e < what.firstElement + what.elementCount; ++e) {
      use.resource = first_[what.entity] + e;
      f(use);
    }
  }
  const std::vector<FlatResource>& resources() const { return resources_; }

 private:
  std::vector<FlatResource> resources_;
  std::vector<std::uint32_t> first_, ofResource_;  // per entity; per FlatResource
};

// As findLive() of the graph, but everything that is disabled or whose condition is false is there, too: a disabled pass
// writes without removing what was there before. Without `histories`, what only later frames read is not alive.
Liveness findReach(const Model& model, const Ground& ground, bool histories);

// A use at a position, in the resources of a Ground.
struct Line {
  std::uint32_t position = 0;
  FlatUse use;
  std::uint32_t who = kNone;
};
// For each of `queries` the `who` of the mark that stands nearest before it (behind it when `behind`), at another position,
// and shares a sub-resource with it; else kNone.
std::vector<std::uint32_t> findNearest(const Ground& ground, const std::vector<Line>& queries,
                                       const std::vector<Line>& marks, bool behind);

}  // namespace weft::graph::expansion
