#include "engine/gl/objects/level_stream.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

namespace weft::gl {

bool LevelStream::advance(base::Diagnostics& diagnostics) {
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
