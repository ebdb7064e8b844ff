#include "engine/imports/row_table.h"

#include <fmt/format.h>

#include "engine/gl/programs/program.h"
#include "engine/text/nearest.h"

namespace weft::imports {

bool rowLayoutOf(const gl::Block& block, std::span<const graph::TableColumn> columns, RowLayout& layout,
                 std::string& problem) {
  layout.offsets.assign(columns.size(), -1);
  for (const gl::BlockMember& member : block.members) {
    const std::size_t dot = member.name.rfind('.');
    const bool row = dot != std::string::npos && dot > 0 && member.name[dot - 1] == ']';
    if (!row || (block.storage && member.topLevelArrayStride == 0)) {
      problem = fmt::format("'{}' is no field of an array of structs", member.name);
      return false;
    }
    if (!block.storage && !member.name.substr(0, dot).ends_with("[0]")) {
      problem = "a uniform block holds one row of a table: declare [1]";
      return false;
    }
    const std::string field = member.name.substr(dot + 1);
    layout.stride = block.storage ? member.topLevelArrayStride : block.bytes;
    const auto column = std::ranges::find(columns, field, &graph::TableColumn::name);
    if (column == columns.end()) {
      std::vector<std::string> names;
      for (const graph::TableColumn& each : columns) names.push_back(each.name);
      const std::string near = text::nearestHint(field, names);
      problem = fmt::format("its rows have no field '{}'{}{}", field, near.empty() ? "" : "; ", near);
      continue;
    }
    const std::string type = gl::glslTypeName(member.type);
    if (type != column->type) problem = fmt::format("'{}' is {}, not {}", field, type, column->type);
    if (member.rowMajor) problem = fmt::format("'{}' is row_major", field);
    layout.offsets[static_cast<std::size_t>(column - columns.begin())] =
        static_cast<std::int32_t>(member.offset);
  }
  if (layout.stride == 0 && problem.empty()) problem = "the block is no array of structs";
  return problem.empty();
}

bool sendTo(gl::Buffer& buffer, std::span<const std::byte> bytes, const std::string& label, bool grows,
            text::Diagnostics& diagnostics) {
  if (!buffer || (grows ? buffer.bytes() < bytes.size() : buffer.bytes() != bytes.size())) {
    auto made = gl::Buffer::create(bytes.size() + (grows ? bytes.size() / 2 : 0), GL_DYNAMIC_STORAGE_BIT,
                                   label, diagnostics);
    buffer = made ? std::move(*made) : gl::Buffer();  // one that is too small must not be given out
    if (!buffer) return false;
  }
  gl::uploadBuffer(buffer.id(), 0, bytes);
  return true;
}

}  // namespace weft::imports
