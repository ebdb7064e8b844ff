#include "engine/gl/context/state_cache.h"

#include <algorithm>
#include <cassert>

namespace weft::gl {

// Keeps the vectors' memory: a frame allocates nothing.
void StateCache::forget() {
  program_ = framebuffer_ = vertexArray_ = stencilMask_ = std::nullopt;
  std::ranges::fill(textures_, std::nullopt);
  std::ranges::fill(samplers_, std::nullopt);
  std::ranges::fill(images_, std::nullopt);
  std::ranges::fill(uniformBuffers_, std::nullopt);
  std::ranges::fill(storageBuffers_, std::nullopt);
  scissorTest_ = depthTest_ = cull_ = srgb_ = offsetFill_ = depthMask_ = colorMask_ = std::nullopt;
  viewport_ = std::nullopt;
  scissor_ = std::nullopt;
  depthFunc_ = cullFace_ = polygonMode_ = std::nullopt;
  offset_ = std::nullopt;
  std::ranges::fill(drawBuffers_, DrawBuffer{});
}

void StateCache::bindBuffer(GLenum target, GLuint index, GLuint buffer, GLintptr offset, GLsizeiptr size) {
  assert(target == GL_UNIFORM_BUFFER || target == GL_SHADER_STORAGE_BUFFER);
  auto& known = target == GL_UNIFORM_BUFFER ? uniformBuffers_ : storageBuffers_;
  if (!takes(slotAt(known, index), Range{buffer, offset, size})) return;
  if (size == 0)
    glBindBufferBase(target, index, buffer);
  else
    glBindBufferRange(target, index, buffer, offset, size);
}

void StateCache::enable(GLenum capability, bool on) {
  std::optional<bool>& known = capability == GL_SCISSOR_TEST       ? scissorTest_
                               : capability == GL_DEPTH_TEST       ? depthTest_
                               : capability == GL_CULL_FACE        ? cull_
                               : capability == GL_FRAMEBUFFER_SRGB ? srgb_
                                                                   : offsetFill_;
  assert(&known != &offsetFill_ || capability == GL_POLYGON_OFFSET_FILL);
  if (!takes(known, on)) return;
  if (on)
    glEnable(capability);
  else
    glDisable(capability);
}

void StateCache::blend(GLuint index, const std::optional<Blend>& mode) {
  if (index >= drawBuffers_.size()) drawBuffers_.resize(index + 1);
  DrawBuffer& known = drawBuffers_[index];
  if (takes(known.on, mode.has_value())) {
    if (mode)
      glEnablei(GL_BLEND, index);
    else
      glDisablei(GL_BLEND, index);
  }
  if (!mode || known.mode == mode) return;
  const bool sameEquation = known.mode && known.mode->equation == mode->equation;
  Blend factors = *mode;
  if (known.mode) factors.equation = known.mode->equation;
  if (!sameEquation) glBlendEquationi(index, mode->equation);
  if (!known.mode || factors != *known.mode)
    glBlendFuncSeparatei(index, mode->source, mode->destination, mode->sourceAlpha, mode->destinationAlpha);
  known.mode = mode;
}

}  // namespace weft::gl
