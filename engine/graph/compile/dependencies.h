// The edges between passes, computed on demand (random orders, DOT, explain); the declared order needs none.
// One edge per pair and resource, per kind: read after write, write after read, write after write, per
// sub-resource of one FlatResource. History orders nothing; resources that only share storage order nothing.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "engine/graph/plan.h"

namespace weft::graph {

struct Dependency {
  enum class Type : std::uint8_t { read_after_write, write_after_read, write_after_write };
  std::uint32_t from = 0, to = 0;  // passes; `from` runs first
  std::uint32_t resource = 0;
  Type type = Type::read_after_write;
  friend auto operator<=>(const Dependency&, const Dependency&) = default;
};

// In declared order of `to`, then of `from`: between live passes, by the uses that are `attached`; over every pass and use,
// culled ones too, without it.
std::vector<Dependency> dependencies(const FlatGraph& graph,
                                     const std::vector<std::uint8_t>* attached = nullptr);

}  // namespace weft::graph
