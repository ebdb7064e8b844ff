#include "engine/gl/context/state_cache.h"

#include <algorithm>
#include <cassert>

namespace weft::gl {

void StateCache::bindBuffer(GLenum target, GLuint index, GLuint buffer, GLintptr offset, GLsizeiptr size) {
  assert(target == GL_UNIFORM_BUFFER || target == GL_SHADER_STORAGE_BUFFER);
  const Call call = target == GL_UNIFORM_BUFFER ? Call::uniform_buffer : Call::storage_buffer;
  if (size != 0)
    setAt(call, index, glBindBufferRange, target, index, buffer, offset, size);
  else
    setAt(call, index, glBindBufferBase, target, index, buffer);
}

void StateCache::enable(GLenum capability, bool on) {
  constexpr GLenum kCapabilities[] = {
      GL_SCISSOR_TEST, GL_DEPTH_TEST,  GL_CULL_FACE,   GL_POLYGON_OFFSET_FILL,      GL_FRAMEBUFFER_SRGB,
      GL_STENCIL_TEST, GL_DEPTH_CLAMP, GL_SAMPLE_MASK, GL_SAMPLE_ALPHA_TO_COVERAGE, GL_PROGRAM_POINT_SIZE};
  const auto at = std::ranges::find(kCapabilities, capability) - std::begin(kCapabilities);
  assert(at < std::ssize(kCapabilities));
  if (takes(Call::capability, static_cast<GLuint>(at), {on ? 1.0 : 0.0}))
    (on ? glEnable : glDisable)(capability);
}

void StateCache::blend(GLuint index, bool on) {
  if (takes(Call::blend, index, {on ? 1.0 : 0.0})) (on ? glEnablei : glDisablei)(GL_BLEND, index);
}

void StateCache::openMasks() {
  colorMask(15);
  depthMask(true);
  set(Call::stencil_mask, glStencilMask, 0xff);
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
