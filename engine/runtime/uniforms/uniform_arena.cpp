#include "engine/runtime/uniforms/uniform_arena.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "engine/base/hash.h"

namespace weft::runtime {

namespace {

constexpr std::size_t kLargestMember = 32;  // bytes of a vector of four doubles

}  // namespace

bool UniformArena::layOut(std::span<PreparedPass> passes, base::Diagnostics& diagnostics) {
  std::uint32_t end = 0;
  const auto place = [&](const gl::Block* block, std::uint32_t& offset) {
    offset = end;
    if (block) end += (block->bytes + alignment_ - 1) / alignment_ * alignment_;
  };
  for (PreparedPass& pass : passes) {
    place(pass.parametersBlock, pass.parametersOffset);
    place(pass.viewBlock, pass.viewOffset);
    place(pass.sliceBlock, pass.sliceOffset);
  }
  bytes_.assign(end, std::byte{0});
  if (end == 0) return true;
  auto buffer = gl::Buffer::create(end, GL_DYNAMIC_STORAGE_BIT, "uniforms", diagnostics);
  if (!buffer) return false;
  buffer_ = std::move(*buffer);
  return true;
}

void UniformArena::write(std::uint32_t block, const gl::BlockMember& member, const graph::Value& value) {
  std::byte* const at = bytes_.data() + block + member.offset;
  const std::size_t window = std::min<std::size_t>(kLargestMember, bytes_.size() - block - member.offset);
  std::array<std::byte, kLargestMember> before;
  std::memcpy(before.data(), at, window);
  writeValue(bytes_.data() + block, member, value);
  changed_ |= std::memcmp(before.data(), at, window) != 0;
}

void UniformArena::writeView(std::uint32_t block, const gl::Block& layout, const scene::ViewData& view,
                             glm::vec2 viewport, bool timeless) {
  runtime::writeView(bytes_.data() + block, layout, view, viewport, timeless);
  changed_ = true;
}

std::uint64_t UniformArena::hash(std::uint32_t block, const gl::Block* layout, std::uint64_t seed) const {
  if (!layout) return seed;
  const auto* bytes = reinterpret_cast<const char*>(bytes_.data() + block);
  return base::hashBytes({bytes, layout->bytes}, seed);
}

void UniformArena::upload() {
  if (!changed_ || bytes_.empty()) return;
  gl::uploadBuffer(buffer(), 0, bytes_);
  changed_ = false;
}

}  // namespace weft::runtime
