// The uniform blocks of all passes, one after the other in one buffer. Their bytes are kept on the CPU, and are uploaded
// to the GPU only when a byte has changed. Does not: know which value a uniform has (uniform_values.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/gl/objects/objects.h"
#include "engine/runtime/prepare/prepared_pass.h"
#include "engine/runtime/storage/block_writer.h"

namespace weft::runtime {

class UniformArena {
 public:
  // `alignment` of offsets in bytes, as the device wants it.
  explicit UniformArena(std::uint32_t alignment) : alignment_(alignment) {}

  // Gives each block of `passes` its offset, its bytes 0, and makes the buffer. To be called once. False when the buffer
  // cannot be made.
  bool layOut(std::span<PreparedPass> passes, base::Diagnostics& diagnostics);

  // Writes the bytes of one member. `value` must fit it (memberTakes). `block` is the offset of the block.
  void write(std::uint32_t block, const gl::BlockMember& member, const graph::Value& value);
  void writeView(std::uint32_t block, const gl::Block& layout, const scene::ViewData& view,
                 glm::vec2 viewport, bool timeless);

  // The hash of `seed` and the bytes of a block; `seed` itself when `layout` is null.
  std::uint64_t hash(std::uint32_t block, const gl::Block* layout, std::uint64_t seed) const;
  std::span<const std::byte> bytes() const { return bytes_; }
  GLuint buffer() const { return buffer_.id(); }
  // Sends the bytes when one has changed since the last call.
  void upload();

 private:
  std::uint32_t alignment_;
  std::vector<std::byte> bytes_;
  gl::Buffer buffer_;
  bool changed_ = true;
};

}  // namespace weft::runtime
