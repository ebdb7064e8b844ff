// Random valid FlatGraphs of mixed kinds for property tests: mips, layers, planes, buffers, histories,
// cadences, clears, imports, feedback, several writers, dead ends; few storage classes, so that sharing is
// common.
#pragma once

#include <cstdint>

#include "tests/graph/compile/flat_builder.h"

namespace weft::graph {

FlatBuilder randomGraph(std::uint64_t seed);

}  // namespace weft::graph
