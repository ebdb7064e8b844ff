// Histograms of the presented picture: shares of its texels by luminance and by channel, of a small copy of it.
#pragma once

#include <array>
#include <cstdint>

#include "engine/gl/objects/objects.h"

namespace weft::runtime {

class PictureHistogram {
 public:
  static constexpr std::uint32_t kWidth = 256, kHeight = 144, kFrames = 8;
  using Bins = std::array<float, 256>;  // share of the texels per 8-bit value, as displayed

  // To be called once per frame with the presented level and layer. Every kFrames-th call counts, and waits for the GPU.
  void update(const gl::TextureRef& presented);

  // Red, green, blue, luminance; all zero at first.
  const std::array<Bins, 4>& bins() const { return bins_; }

 private:
  gl::Texture small_;
  gl::Framebuffer target_;
  std::uint32_t calls_ = 0;
  std::array<Bins, 4> bins_{};
};

}  // namespace weft::runtime
