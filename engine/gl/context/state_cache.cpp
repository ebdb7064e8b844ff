#include "engine/gl/context/state_cache.h"

#include <algorithm>
#include <cassert>

namespace weft::gl {

// Keeps the vectors' memory: a frame allocates nothing.
void StateCache::forget() {
  known_ = {};
  enabled_ = {};
  stencil_ = {};
  for (auto* list : {&textures_, &samplers_}) std::ranges::fill(*list, std::nullopt);
  for (auto* list : {&uniformBuffers_, &storageBuffers_}) std::ranges::fill(*list, std::nullopt);
  std::ranges::fill(images_, std::nullopt);
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
  const auto index =
      static_cast<std::size_t>(std::ranges::find(kCapabilities, capability) - kCapabilities.begin());
  assert(index < kCapabilities.size());
  if (!takes(enabled_[index], on)) return;
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
  glBlendEquationSeparatei(index, mode->equation, mode->equationAlpha);
  glBlendFuncSeparatei(index, mode->source, mode->destination, mode->sourceAlpha, mode->destinationAlpha);
  known.mode = mode;
}

void StateCache::openMasks() {
  colorMask(15);
  depthMask(true);
  stencilMask(0xff);
  enable(GL_SCISSOR_TEST, false);
  enable(GL_FRAMEBUFFER_SRGB, false);  // clears and copies do not convert
}

void releaseBindings() {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDisable(GL_FRAMEBUFFER_SRGB);  // presenting does not convert
  glUseProgram(0);
  glBindVertexArray(0);
  glActiveTexture(GL_TEXTURE0);
  glBindTextureUnit(0, 0);
  glBindSampler(0, 0);
}

}  // namespace weft::gl
