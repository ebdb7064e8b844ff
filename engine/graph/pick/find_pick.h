// Finds what a Pick names in a flat graph, and keeps it alive. Does not: parse it (pick.h), or look at it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/graph/flat_graph.h"
#include "engine/graph/pick/pick.h"

namespace weft::graph {

// The name of a resource that all its versions share: "hdr" of "hdr#2".
std::string_view sharedName(std::string_view resourceName);

struct FoundPick {
  std::uint32_t resource = kNone;  // into FlatGraph::resources
  std::uint32_t pass = kNone;      // into FlatGraph::passes; kNone: the last that writes it
  friend bool operator==(const FoundPick&, const FoundPick&) = default;
};

// Nothing after an error: unknownResource, ambiguousName, missingSubresource, noHistory, badSelector, unknownPass.
std::optional<FoundPick> findPick(const FlatGraph& graph, const Pick& pick, base::Diagnostics& diagnostics);

// Makes live what writes each pick that is there, as if it had a side effect.
void keepPicks(FlatGraph& graph, std::span<const Pick> picks, base::Diagnostics& diagnostics);

}  // namespace weft::graph
