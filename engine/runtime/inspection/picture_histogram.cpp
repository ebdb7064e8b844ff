#include "engine/runtime/inspection/picture_histogram.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/runtime/frame/gl_state.h"

namespace weft::runtime {

void PictureHistogram::update(const gl::TextureRef& presented) {
  if (presented.id == 0 || presented.desc.samples > 1 ||
      gl::classOf(presented.desc.format) != gl::FormatClass::floating)
    return;
  text::Diagnostics ignored;
  if (!target_) {
    auto texture =
        gl::Texture::create({.format = GL_RGBA8, .width = kWidth, .height = kHeight}, "histogram", ignored);
    if (!texture) return;
    small_ = std::move(*texture);
    const gl::Attachment to{.texture = small_.id()};
    if (auto target = gl::Framebuffer::create({&to, 1}, "histogram", ignored)) target_ = std::move(*target);
  }
  const gl::Attachment from{.texture = presented.id};
  const auto source = gl::Framebuffer::create({&from, 1}, "histogram", ignored);
  if (!source || !target_) return;
  openMasks();
  glBlitNamedFramebuffer(source->id(), target_.id(), 0, 0, static_cast<GLint>(presented.desc.width),
                         static_cast<GLint>(presented.desc.height), 0, 0, kWidth, kHeight,
                         GL_COLOR_BUFFER_BIT, GL_NEAREST);
  const std::vector<std::byte> bytes = gl::readTexture(small_.ref(), 0, 0, GL_RGBA, GL_UNSIGNED_BYTE);
  for (Bins& bins : bins_) bins.fill(0);
  const float share = 1.0f / static_cast<float>(kWidth * kHeight);
  for (std::size_t i = 0; i + 3 < bytes.size(); i += 4) {
    const auto channel = [&](std::size_t c) { return std::to_integer<std::size_t>(bytes[i + c]); };
    const double luminance = 0.2126 * static_cast<double>(channel(0)) +
                             0.7152 * static_cast<double>(channel(1)) +
                             0.0722 * static_cast<double>(channel(2));
    for (std::size_t c = 0; c < 3; ++c) bins_[c][channel(c)] += share;
    bins_[3][static_cast<std::size_t>(std::lround(luminance))] += share;
  }
}

}  // namespace weft::runtime
