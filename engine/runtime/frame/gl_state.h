// GL state outside of passes: open masks, released bindings, samples.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/gl/context/state_cache.h"
#include "engine/gl/objects/objects.h"

namespace weft::runtime {

// Opens every mask and turns the scissor off, as clears and blits need it.
void openMasks(gl::StateCache& states);
// The same outside the frame loop, where the GL state is not known.
void openMasks();

// GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT or GL_DEPTH_STENCIL_ATTACHMENT, by the internal format.
GLenum attachmentPointOf(GLenum format);
// Writes the mean of the samples, or the first sample of depth and stencil, of a texture to one of the same format and size.
// False when the driver has no framebuffer for them.
bool resolveSamples(const gl::TextureRef& from, GLuint to);

// The rows of a picture, of `row` numbers each, the last one first.
template <class To, class From>
std::vector<To> flipped(const std::vector<From>& texels, std::size_t row) {
  std::vector<To> out;
  out.reserve(texels.size());
  for (std::size_t end = texels.size(); end > 0; end -= row)
    for (std::size_t i = end - row; i < end; ++i) out.push_back(static_cast<To>(texels[i]));
  return out;
}

// Binds framebuffer 0 for drawing and reading, and no program, vertex array, or texture and sampler in unit 0. A library that
// draws over the picture starts from there, so that it puts back nothing afterwards that a reload may have deleted.
void releaseBindings();

}  // namespace weft::runtime
