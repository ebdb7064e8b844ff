// Tables that shaders read as an array of structs in a storage block, or their first row in a uniform block. Introspection tells which fields of a row a shader
// declares, and where; so no struct is written twice. A shader may leave fields out and put them in any order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/gl/programs/program.h"
#include "engine/graph/registry.h"

namespace weft::imports {

// The storage block that has the rows of a draw pass's list, although no slot names it.
constexpr const char* kInstancesBlock = "instances";

// Byte offsets of a table's columns within one element of a storage block, in the order of the columns; -1: the shader has no
// such field.
struct RowLayout {
  std::uint32_t stride = 0;
  std::vector<std::int32_t> offsets;
  friend bool operator==(const RowLayout&, const RowLayout&) = default;
};
// False, with the problem, when the block is no array of a struct with fields among `columns`.
bool rowLayoutOf(const gl::Block& block, std::span<const graph::TableColumn> columns, RowLayout& layout,
                 std::string& problem);

}  // namespace weft::imports
