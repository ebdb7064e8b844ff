// The neutral workload form, for measuring the core: {"textures": [{name, width, height, format}], "passes":
// [{name, reads, writes, side_effect}]}. It is read straight into a FlatGraph. Reads are sampled; writes are colour (depth
// for depth formats) and kept: a live pass makes all that it writes. This is not the language of graph files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/base/diagnostic.h"
#include "engine/graph/flat_graph.h"

namespace weft::graph {

struct NeutralOptions {
  bool everySecondCompute = false;  // passes 1, 3, 5, … read and write by image where the format can
};

// Empty after errors (W093 to W096), all reported at once with their places; unknown keys are errors.
std::optional<FlatGraph> readNeutral(std::string_view text, const std::string& path,
                                     const NeutralOptions& options, base::Diagnostics& diagnostics);

enum class NeutralShape : std::uint8_t { chain, layered, fanin };

// A workload of `passes` passes, of which the last has the only side effect. layered: each pass reads the
// oldest texture nobody has read and two of the last 32 passes', and writes one or two (some 93 % of the
// passes live); fanin: groups of eight chains of three that are merged. The same arguments give the same
// text.
std::string neutralText(NeutralShape shape, std::size_t passes, std::uint64_t seed = 1);

}  // namespace weft::graph
