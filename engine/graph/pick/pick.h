// What a person names to look at in a graph that runs: `hdr`, `hdr#1`, `glow.mip[2]`, `sky.face[4]`, `depth.stencil`, `adapted@-1`,
// `hdr after bloom`; found in a flat graph, and kept alive.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/graph/flat_graph.h"
#include "engine/text/diagnostic.h"

namespace weft::graph {

struct Pick {
  std::string text;           // as written
  std::string name;           // of a resource, or any unique suffix: "hdr", "maps[2]"
  std::uint32_t version = 0;  // k of #k, from 1; 0: the last
  std::uint32_t mip = 0;
  std::uint32_t layer = 0;    // array layer, cube * 6 + face, or slice of a 3D texture
  std::uint32_t history = 0;  // n of @-n
  bool stencil = false;
  std::string pass;      // after which to look, or any unique suffix; "": the last that writes it
  std::string option{};  // that names it, for messages: "-o"
  friend bool operator==(const Pick&, const Pick&) = default;
};

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
