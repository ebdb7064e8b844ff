#include "engine/imports/row_table.h"

namespace weft::imports {

RowBuffers::Copy& RowBuffers::copyOf(const RowLayout& layout) {
  const auto known = std::ranges::find_if(copies_, [&](const auto& each) { return each->layout == layout; });
  if (known != copies_.end()) return **known;
  return *copies_.emplace_back(std::make_unique<Copy>(Copy{.layout = layout, .buffer = {}}));
}

bool RowBuffers::send(Copy& copy, std::vector<std::byte>& bytes, base::Diagnostics& diagnostics) {
  bytes.resize(std::max<std::size_t>(bytes.size(), 16));
  if (!copy.buffer || copy.buffer.bytes() != bytes.size()) {
    auto buffer = gl::Buffer::create(bytes.size(), GL_DYNAMIC_STORAGE_BIT, label_, diagnostics);
    if (!buffer) return false;
    copy.buffer = std::move(*buffer);
  }
  gl::uploadBuffer(copy.buffer.id(), 0, bytes);
  return true;
}

}  // namespace weft::imports
