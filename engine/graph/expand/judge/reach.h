// What would live if all that is switched off were there, and who stands nearest to a use in declared order. Both go along
// the one walk of versions. Does not: judge or say anything.
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
  // Calls f(use) for what `rect` is of each element.
  template <class F>
  void eachElement(std::uint32_t entity, std::uint32_t first, std::uint32_t count, FlatUse rect,
                   F&& f) const {
    if (first_[entity] == kNone) return;
    for (std::uint32_t e = first; e < first + count; ++e) {
      rect.resource = first_[entity] + e;
      f(rect);
    }
  }
  const std::vector<FlatResource>& resources() const { return resources_; }

 private:
  std::vector<FlatResource> resources_;
  std::vector<std::uint32_t> first_, ofResource_;  // per entity; per FlatResource
};

// As findLive() of the graph, but everything that is disabled or whose condition is false is there, too: a disabled pass
// writes without taking away what was there before.
Liveness findReach(const Model& model, const Ground& ground);
// The same without what only later frames read, by a history.
Liveness findReachNow(const Model& model, const Ground& ground);

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
