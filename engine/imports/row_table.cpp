#include "engine/imports/row_table.h"

#include <algorithm>

namespace weft::imports {

RowTable::Copy& RowTable::copyOf(const RowLayout& layout) {
  const auto known = std::ranges::find_if(copies_, [&](const auto& each) { return each->layout == layout; });
  if (known != copies_.end()) return **known;
  return *copies_.emplace_back(std::make_unique<Copy>(Copy{.layout = layout, .buffer = {}}));
}

bool RowTable::send(Copy& copy, base::Diagnostics& diagnostics) {
  bytes_.resize(std::max<std::size_t>(bytes_.size(), 16));
  if (!copy.buffer || copy.buffer.bytes() != bytes_.size()) {
    auto buffer = gl::Buffer::create(bytes_.size(), GL_DYNAMIC_STORAGE_BIT, label_, diagnostics);
    if (!buffer) return false;
    copy.buffer = std::move(*buffer);
  }
  gl::uploadBuffer(copy.buffer.id(), 0, bytes_);
  return true;
}

}  // namespace weft::imports
