// Tables of rows on the device, which shaders read as an array of structs in a storage block, or their first row in a uniform
// block. Introspection tells which fields of a row a shader declares, and where, so no struct is written twice; a shader may
// leave fields out and put them in any order. A column is written in one place: its name, what graphs are told of it, and how
// its value is found in a row. A table is held in as many layouts as shaders ask for; each is filled when it is older than
// the rows.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/gl/objects/objects.h"
#include "engine/graph/registry.h"
#include "engine/imports/world.h"
#include "engine/text/diagnostic.h"

namespace weft::gl {
struct Block;
}

namespace weft::imports {

// The storage block that has the rows of a draw pass's list, although no slot names it.
constexpr const char* kInstancesBlock = "instances";

// Byte offsets of a table's columns within one element of a storage block, in the order of the columns; -1: no such field.
struct RowLayout {
  std::uint32_t stride = 0;
  std::vector<std::int32_t> offsets;
  friend bool operator==(const RowLayout&, const RowLayout&) = default;
};
// False, with the problem, when the block is no array of a struct with fields among `columns`.
bool rowLayoutOf(const gl::Block& block, std::span<const graph::TableColumn> columns, RowLayout& layout,
                 std::string& problem);

template <class Value>
constexpr const char* glslTypeOf() {
  if constexpr (std::is_same_v<Value, float>) return "float";
  if constexpr (std::is_same_v<Value, std::int32_t>) return "int";
  if constexpr (std::is_same_v<Value, std::uint32_t>) return "uint";
  if constexpr (std::is_same_v<Value, glm::vec2>) return "vec2";
  if constexpr (std::is_same_v<Value, glm::vec3>) return "vec3";
  if constexpr (std::is_same_v<Value, glm::vec4>) return "vec4";
  if constexpr (std::is_same_v<Value, glm::mat4>) return "mat4";
}

// A value of a table on the CPU; of a matrix column by column.
using Numbers = std::array<double, 16>;

template <class Row>
struct Column {
  graph::TableColumn told;
  void (*read)(const Row& row, Numbers& out) = nullptr;
  void (*write)(std::span<const Row> rows, std::byte* out, std::size_t stride) = nullptr;
};

// `Get` is a member of Row or a function of a row. What it gives says the type of the column; a bool is a uint.
template <class Row, auto Get>
Column<Row> column(std::string name, std::string doc = {}) {
  using Given = std::remove_cvref_t<std::invoke_result_t<decltype(Get), const Row&>>;
  using Value = std::conditional_t<std::is_same_v<Given, bool>, std::uint32_t, Given>;
  return {{std::move(name), glslTypeOf<Value>(), std::move(doc)},
          [](const Row& row, Numbers& out) {
            const Value value = std::invoke(Get, row);
            if constexpr (std::is_arithmetic_v<Value>)
              out[0] = value;
            else
              std::copy_n(glm::value_ptr(value), sizeof value / sizeof(float), out.begin());
          },
          [](std::span<const Row> rows, std::byte* out, std::size_t stride) {
            for (const Row& row : rows) {
              const Value value = std::invoke(Get, row);
              std::memcpy(out, &value, sizeof value);
              out += stride;
            }
          }};
}

template <class Row>
using Columns = std::vector<Column<Row>>;

// For reflect().
template <class Row>
std::vector<graph::TableColumn> tell(const Columns<Row>& columns) {
  std::vector<graph::TableColumn> all;
  for (const Column<Row>& each : columns) all.push_back(each.told);
  return all;
}

// `out` becomes the rows, and at least one. What a layout leaves out is dropped, padding is zero.
template <class Row>
void writeRows(const RowLayout& layout, const Columns<Row>& columns, std::span<const Row> rows,
               std::vector<std::byte>& out) {
  constexpr std::size_t kTogether = 256;  // these stay in the cache while their columns are written
  out.assign(std::max<std::size_t>(rows.size(), 1) * layout.stride, std::byte{0});
  for (std::size_t first = 0; first < rows.size(); first += kTogether) {
    const auto some = rows.subspan(first, std::min(kTogether, rows.size() - first));
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (layout.offsets[c] >= 0)
        columns[c].write(some,
                         out.data() + first * layout.stride + static_cast<std::size_t>(layout.offsets[c]),
                         layout.stride);
  }
}

// Sends bytes to a buffer, which is made anew where it has another size; or, if it `grows`, where it is too small, with half as much
// again. False after an error, and the buffer is none.
bool sendTo(gl::Buffer& buffer, std::span<const std::byte> bytes, const std::string& label, bool grows,
            text::Diagnostics& diagnostics);

template <class Row>
class RowTable {
 public:
  RowTable(std::string label, Columns<Row> columns)
      : label_(std::move(label)), columns_(std::move(columns)) {}

  // `rows()` gives all rows; it is called when a layout is of another generation. Id 0 after an error.
  template <class Rows>
  BufferRef get(const RowLayout& layout, std::uint64_t generation, const Rows& rows,
                text::Diagnostics& diagnostics) {
    auto copy = std::ranges::find(copies_, layout, &Copy::layout);
    if (copy == copies_.end()) copy = copies_.insert(copy, Copy{.layout = layout, .buffer = {}});
    if (copy->generation != generation) {
      const auto& all = rows();
      writeRows(layout, columns_, std::span<const Row>(all), bytes_);
      bytes_.resize(std::max<std::size_t>(bytes_.size(), 16));
      if (!sendTo(copy->buffer, bytes_, label_, false, diagnostics)) return {};
      copy->generation = generation;
    }
    return {copy->buffer.id(), copy->buffer.bytes()};
  }

  // As Provider::value().
  bool read(std::span<const Row> rows, std::size_t row, std::uint32_t column, Numbers& out) const {
    if (row < rows.size()) columns_[column].read(rows[row], out);
    return row < rows.size();
  }

 private:
  struct Copy {
    RowLayout layout;
    gl::Buffer buffer;
    std::uint64_t generation = 0;
  };
  std::string label_;
  Columns<Row> columns_;
  std::vector<Copy> copies_;
  std::vector<std::byte> bytes_;
};

}  // namespace weft::imports
