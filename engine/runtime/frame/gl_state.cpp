#include "engine/runtime/frame/gl_state.h"

namespace weft::runtime {

void openMasks(gl::StateCache& states) {
  states.colorMask(15);
  states.depthMask(true);
  states.stencilMask(0xff);
  states.enable(GL_SCISSOR_TEST, false);
  states.enable(GL_FRAMEBUFFER_SRGB, false);  // clears and copies do not convert
}

void openMasks() {
  gl::StateCache unknown;
  openMasks(unknown);
}

GLenum attachmentPointOf(GLenum format) {
  const gl::FormatClass kind = gl::classOf(format);
  return kind == gl::FormatClass::depth           ? GL_DEPTH_ATTACHMENT
         : kind == gl::FormatClass::depth_stencil ? GL_DEPTH_STENCIL_ATTACHMENT
                                                  : GL_COLOR_ATTACHMENT0;
}

bool resolveSamples(const gl::TextureRef& from, GLuint to) {
  text::Diagnostics ignored;
  const GLenum point = attachmentPointOf(from.desc.format);
  const gl::Attachment ends[] = {{.point = point, .texture = from.id}, {.point = point, .texture = to}};
  const auto source = gl::Framebuffer::create({&ends[0], 1}, "samples", ignored),
             target = gl::Framebuffer::create({&ends[1], 1}, "samples", ignored);
  if (!source || !target) return false;
  openMasks();
  const auto width = static_cast<GLint>(from.desc.width), height = static_cast<GLint>(from.desc.height);
  const GLbitfield mask = point == GL_COLOR_ATTACHMENT0  ? GL_COLOR_BUFFER_BIT
                          : point == GL_DEPTH_ATTACHMENT ? GL_DEPTH_BUFFER_BIT
                                                         : GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT;
  glBlitNamedFramebuffer(source->id(), target->id(), 0, 0, width, height, 0, 0, width, height, mask,
                         GL_NEAREST);
  return true;
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

}  // namespace weft::runtime
