// Texels of large textures, a portion at a time, so that no frame waits for them.
#pragma once

#include <array>

#include "engine/gl/objects/objects.h"

namespace weft::gl {

// Fills one level of a 2D texture a portion of rows at a time, through a ring of persistently mapped pixel-unpack buffers:
// the copy into a buffer is the only work of the calling thread, and a buffer is written again only when the fence behind
// its last transfer has signalled. Nothing here waits, for the GPU or anything else.
class PixelStream {
 public:
  // `rowsPerPortion` rows of (format, type) fit a buffer; at least one. W117 when memory is out.
  static std::optional<PixelStream> create(const TextureRef& texture, std::uint32_t mip, GLenum format,
                                           GLenum type, std::uint32_t rowsPerPortion, std::string_view label,
                                           text::Diagnostics& diagnostics);

  // Sends the next portion of `texels`, which are those of the whole level and the same in every call, or
  // nothing when the GPU still reads the next buffer.
  void advance(std::span<const std::byte> texels);
  // Rows that are sent.
  std::uint32_t rows() const { return row_; }
  bool sentAll() const { return row_ == extent_.height; }

 private:
  static constexpr std::size_t kBuffers = 3;  // one written, one read, one between
  struct Portion {
    Buffer buffer;
    std::byte* mapped = nullptr;
    Fence fence;  // behind the last transfer out of it
  };
  TextureRef texture_;
  Extent extent_;
  std::uint32_t mip_ = 0, rowsPerPortion_ = 1, row_ = 0;
  std::size_t rowBytes_ = 0, next_ = 0;
  GLenum format_ = 0, type_ = 0;
  std::array<Portion, kBuffers> ring_;
};

}  // namespace weft::gl
