#include "engine/gl/objects/streams.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>

namespace weft::gl {

std::optional<PixelStream> PixelStream::create(const TextureRef& texture, std::uint32_t mip, GLenum format,
                                               GLenum type, std::uint32_t rowsPerPortion,
                                               std::string_view label, text::Diagnostics& diagnostics) {
  assert(texture.desc.target == GL_TEXTURE_2D && mip < texture.desc.mips);
  PixelStream stream;
  stream.texture_ = texture;
  stream.extent_ = extentOf(texture.desc, mip);
  stream.mip_ = mip;
  stream.format_ = format;
  stream.type_ = type;
  stream.rowsPerPortion_ = std::clamp(rowsPerPortion, 1u, stream.extent_.height);
  stream.rowBytes_ = std::size_t{stream.extent_.width} * texelBytes(format, type);
  const std::uint64_t bytes = stream.rowBytes_ * stream.rowsPerPortion_;
  const std::uint32_t portions =
      (stream.extent_.height + stream.rowsPerPortion_ - 1) / stream.rowsPerPortion_;
  constexpr GLbitfield kFlags = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  for (std::size_t i = 0; i < std::min<std::size_t>(kBuffers, portions); ++i) {
    auto buffer = Buffer::create(bytes, kFlags, label, diagnostics);
    if (!buffer) return std::nullopt;
    void* mapped = glMapNamedBufferRange(buffer->id(), 0, static_cast<GLsizeiptr>(bytes), kFlags);
    if (!mapped) {
      diagnostics.error(text::Code::bufferNotCreated, {}, "a pixel buffer cannot be mapped").resource = label;
      return std::nullopt;
    }
    stream.ring_[i].buffer = std::move(*buffer);
    stream.ring_[i].mapped = static_cast<std::byte*>(mapped);
  }
  return stream;
}

void PixelStream::advance(std::span<const std::byte> texels) {
  assert(texels.size() == rowBytes_ * extent_.height);
  Portion& portion = ring_[next_];
  if (sentAll() || !portion.fence.isSignalled()) return;
  const std::uint32_t rows = std::min(rowsPerPortion_, extent_.height - row_);
  std::memcpy(portion.mapped, texels.data() + row_ * rowBytes_, rows * rowBytes_);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, portion.buffer.id());
  glTextureSubImage2D(texture_.id, static_cast<GLint>(mip_), 0, static_cast<GLint>(row_),
                      static_cast<GLsizei>(extent_.width), static_cast<GLsizei>(rows), format_, type_,
                      nullptr);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  portion.fence = Fence::insert();
  row_ += rows;
  next_ = (next_ + 1) % kBuffers;
}

bool LevelStream::advance(text::Diagnostics& diagnostics) {
  assert(texture_.desc.target == GL_TEXTURE_2D && texelsPerPortion_ > 0);
  if (madeAll()) return true;
  const Extent above = extentOf(texture_.desc, level_ - 1), mine = extentOf(texture_.desc, level_);
  const std::uint64_t texels = std::uint64_t{mine.width} * mine.height;
  if (texels <= texelsPerPortion_) {
    makeLevels(texture_.desc.mips - 1);
    return true;
  }
  if (!std::has_single_bit(above.width) || !std::has_single_bit(above.height) || mine.width == above.width ||
      mine.height == above.height) {
    makeLevels(level_);
    return true;
  }
  if (row_ == 0) {
    const std::array<Attachment, 2> levels{Attachment{.texture = texture_.id, .mip = level_ - 1},
                                           Attachment{.texture = texture_.id, .mip = level_}};
    auto from = Framebuffer::create({&levels[0], 1}, "a level", diagnostics);
    auto to = Framebuffer::create({&levels[1], 1}, "the next level", diagnostics);
    if (!from || !to) return false;
    from_ = std::move(*from);
    to_ = std::move(*to);
  }
  const std::uint32_t rows = std::clamp(texelsPerPortion_ / mine.width, 1u, mine.height - row_);
  const auto x = static_cast<GLint>(mine.width), y = static_cast<GLint>(row_),
             end = static_cast<GLint>(row_ + rows);
  glDisable(GL_SCISSOR_TEST);
  glBlitNamedFramebuffer(from_.id(), to_.id(), 0, 2 * y, 2 * x, 2 * end, 0, y, x, end, GL_COLOR_BUFFER_BIT,
                         GL_LINEAR);
  row_ += rows;
  if (row_ < mine.height) return true;
  from_ = {};
  to_ = {};
  row_ = 0;
  ++level_;
  return true;
}

void LevelStream::makeLevels(std::uint32_t last) {
  glTextureParameteri(texture_.id, GL_TEXTURE_BASE_LEVEL, static_cast<GLint>(level_ - 1));
  glTextureParameteri(texture_.id, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(last));
  glGenerateTextureMipmap(texture_.id);
  glTextureParameteri(texture_.id, GL_TEXTURE_BASE_LEVEL, 0);
  glTextureParameteri(texture_.id, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(texture_.desc.mips - 1));
  level_ = last + 1;
}

float LevelStream::done() const {
  std::uint64_t all = 0, made = 0;
  for (std::uint32_t level = 1; level < texture_.desc.mips; ++level) {
    const Extent extent = extentOf(texture_.desc, level);
    all += std::uint64_t{extent.width} * extent.height;
    if (level < level_) made += std::uint64_t{extent.width} * extent.height;
    if (level == level_) made += std::uint64_t{extent.width} * row_;
  }
  return all == 0 ? 1 : static_cast<float>(made) / static_cast<float>(all);
}

}  // namespace weft::gl
