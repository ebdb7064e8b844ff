#include "engine/runtime/uniforms/uniform_arena.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "engine/base/hash.h"

namespace weft::runtime {

namespace {

constexpr std::size_t kLargestMember = 32;  // bytes of a vector of four doubles

// Bytes from `at` on that no block has.
struct Gap {
  std::uint32_t at = 0, bytes = 0;
};

}  // namespace

std::vector<UniformArena::Place> UniformArena::placesOf(std::span<PreparedPass* const> passes) const {
  std::vector<Place> places;
  const auto add = [&](const gl::Block* block, std::uint32_t& offset) {
    if (block) places.push_back({&offset, (block->bytes + alignment_ - 1) / alignment_ * alignment_});
  };
  for (PreparedPass* pass : passes) {
    add(pass->parametersBlock, pass->parametersOffset);
    add(pass->viewBlock, pass->viewOffset);
    add(pass->sliceBlock, pass->sliceOffset);
  }
  return places;
}

bool UniformArena::layOut(std::span<PreparedPass* const> passes, base::Diagnostics& diagnostics) {
  std::vector<Place> places = placesOf(passes);
  const auto middle = std::ranges::stable_partition(places, [](const Place& place) {
                        return *place.offset != PreparedPass::kNoPlace;
                      }).begin();
  const std::span<Place> kept(places.begin(), middle), fresh(middle, places.end());
  std::ranges::sort(kept, {}, [](const Place& place) { return *place.offset; });
  std::vector<Gap> gaps;
  std::uint32_t end = 0, used = 0;
  for (const Place& place : kept) {
    if (*place.offset > end) gaps.push_back({end, *place.offset - end});
    end = *place.offset + place.bytes;
    used += place.bytes;
  }
  for (const Place& place : fresh) {
    const auto gap = std::ranges::find_if(gaps, [&](const Gap& each) { return each.bytes >= place.bytes; });
    std::uint32_t& at = gap == gaps.end() ? end : gap->at;
    *place.offset = at;
    at += place.bytes;
    if (gap != gaps.end()) gap->bytes -= place.bytes;
    used += place.bytes;
  }
  const bool grows = end > bytes_.size(), together = grows && end / 2 > used;
  const std::size_t needed = together ? used : std::max<std::size_t>(end, bytes_.size());
  bool made = true;
  if (needed > (buffer_ ? buffer_->bytes() : 0)) {
    auto buffer = gl::Buffer::create(needed, GL_DYNAMIC_STORAGE_BIT, "uniforms", diagnostics);
    made = buffer.has_value();
    if (made) buffer_ = std::make_shared<const gl::Buffer>(std::move(*buffer));
    changed_ = true;
  }
  if (grows) bytes_.resize(end);
  for (const Place& place : fresh) std::fill_n(bytes_.begin() + *place.offset, place.bytes, std::byte{0});
  if (together && made) moveTogether(places);
  changed_ |= !fresh.empty();
  return made;
}

void UniformArena::moveTogether(std::span<const Place> places) {
  std::vector<std::byte> together;
  for (const Place& place : places) {
    const auto from = bytes_.begin() + *place.offset;
    *place.offset = static_cast<std::uint32_t>(together.size());
    together.insert(together.end(), from, from + place.bytes);
  }
  bytes_ = std::move(together);
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
