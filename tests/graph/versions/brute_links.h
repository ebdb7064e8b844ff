// Version links from their definition, by looking through all uses for every sub-resource.
#pragma once

#include <string>

#include "engine/graph/flat_graph.h"

namespace weft::graph::checks {

struct LinkCount {
  std::size_t links = 0, several = 0, none = 0, histories = 0;  // several: more than one run

  LinkCount& operator+=(const LinkCount& other) {
    links += other.links;
    several += other.several;
    none += other.none;
    histories += other.histories;
    return *this;
  }
};

// "" or the first use whose link is not: for every sub-resource, its last writer in declared order before the pass that
// reads or modifies it; for earlier frames, present and outputs the last writer of all. Adds to `count`.
std::string checkLinks(const FlatGraph& graph, LinkCount& count);

}  // namespace weft::graph::checks
