// Picks (desc.h), what a person names to look at in a graph that runs: `hdr`, `hdr#1`, `glow.mip[2]`, `sky.face[4]`, `depth.stencil`, `adapted@-1`,
// `hdr after bloom`; found in a flat graph, and kept alive.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "engine/graph/flat_graph.h"
#include "engine/text/diagnostic.h"

namespace weft::graph {

// name ["#" k] { ".mip[" i "]" | ".layer[" i "]" | ".face[" i "]" | ".stencil" } ["@-" n] [" after " pass]. Nothing when `text` is
// spelled in another way.
std::optional<Pick> parsePick(std::string_view text);

// Whether `text` matches `pattern`, in which * stands for any letters and ? for one.
bool matchesPattern(std::string_view pattern, std::string_view text);

// The name of a resource that all its versions share: "hdr" of "hdr#2".
std::string_view sharedName(std::string_view resourceName);

struct FoundPick {
  std::uint32_t resource = kNone;  // into FlatGraph::resources
  std::uint32_t pass = kNone;      // into FlatGraph::passes; kNone: the last that writes it
  friend bool operator==(const FoundPick&, const FoundPick&) = default;
};

// Nothing after an error: unknownResource, ambiguousName, missingSubresource, noHistory, badSelector, unknownPass.
std::optional<FoundPick> findPick(const FlatGraph& graph, const Pick& pick, text::Diagnostics& diagnostics);

// Makes live what writes each pick that is there, as if it had a side effect.
void keepPicks(FlatGraph& graph, std::span<const Pick> picks, text::Diagnostics& diagnostics);

}  // namespace weft::graph
