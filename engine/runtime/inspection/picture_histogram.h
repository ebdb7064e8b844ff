// Histograms of the presented picture: shares of its texels by luminance and by channel. They come from a small copy, which
// is read back some frames later, without waiting.
#pragma once

#include <array>
#include <cstdint>

#include "engine/gl/objects/objects.h"

namespace weft::runtime {

class PictureHistogram {
 public:
  static constexpr std::uint32_t kWidth = 256, kHeight = 144;
  using Bins = std::array<float, 256>;  // share of the texels per 8-bit value, as displayed

  // To be called once per frame with the presented level and layer. Starts a copy when none is on its way, and takes the
  // result of one that has arrived.
  void update(const gl::TextureRef& presented);

  // Red, green, blue, luminance; all zero before the first result. Count of results so far.
  const std::array<Bins, 4>& bins() const { return bins_; }
  std::uint64_t results() const { return results_; }

 private:
  bool prepare();
  void count();

  gl::Texture small_;
  gl::Framebuffer target_;
  gl::Buffer buffer_;
  gl::Fence fence_;
  bool pending_ = false;
  std::array<Bins, 4> bins_{};
  std::uint64_t results_ = 0;
};

}  // namespace weft::runtime
