// Histograms of the presented picture: shares of its texels by luminance and by channel, of a small copy of it.
#pragma once

#include <array>
#include <cstdint>

#include "engine/gl/objects/objects.h"

namespace weft::runtime {

class PictureHistogram {
 public:
  static constexpr std::uint32_t kWidth = 256, kHeight = 144;
  using Bins = std::array<float, 256>;  // share of the texels per 8-bit value, as displayed

  // Of the presented level and layer. Waits for the GPU.
  void update(const gl::TextureRef& presented);

  // Red, green, blue, luminance; all zero at first.
  const std::array<Bins, 4>& bins() const { return bins_; }

 private:
  gl::Texture small_;
  gl::Framebuffer target_;
  std::array<Bins, 4> bins_{};
};

}  // namespace weft::runtime
