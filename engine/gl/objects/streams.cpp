#include "engine/gl/objects/streams.h"

#include <algorithm>
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

}  // namespace weft::gl
