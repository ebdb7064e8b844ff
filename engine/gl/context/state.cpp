#include "engine/gl/context/state.h"

namespace weft::gl {

void enable(GLenum capability, bool on) {
  (on ? glEnable : glDisable)(capability);
}

void bindBuffer(GLenum target, GLuint index, GLuint buffer, GLintptr offset, GLsizeiptr size) {
  if (size != 0)
    glBindBufferRange(target, index, buffer, offset, size);
  else
    glBindBufferBase(target, index, buffer);
}

void openMasks() {
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glStencilMask(0xff);
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
