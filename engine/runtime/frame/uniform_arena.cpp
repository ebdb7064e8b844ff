#include "engine/runtime/frame/uniform_arena.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "engine/base/hash.h"

namespace weft::runtime {

namespace {

constexpr std::size_t kLargestMember = 32;  // bytes of a vector of four doubles

}  // namespace

void UniformArena::layOut(std::span<PreparedPass* const> passes, base::Diagnostics& diagnostics) {
  std::uint32_t total = 0;
  const auto place = [&](const gl::Block* block) {
    const std::uint32_t at = total;
    if (block) total += (block->bytes + alignment_ - 1) / alignment_ * alignment_;
    return at;
  };
  for (PreparedPass* pass : passes) {
    pass->parametersOffset = place(pass->parametersBlock);
    pass->viewOffset = place(pass->viewBlock);
    pass->sliceOffset = place(pass->sliceBlock);
  }
  bytes_.assign(total, std::byte{0});
  changed_ = true;
  if (total == 0 || (buffer_ && buffer_.bytes() >= total)) return;
  auto buffer = gl::Buffer::create(total, GL_DYNAMIC_STORAGE_BIT, "uniforms", diagnostics);
  if (buffer) buffer_ = std::move(*buffer);
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
  gl::uploadBuffer(buffer_.id(), 0, bytes_);
  changed_ = false;
}

}  // namespace weft::runtime
