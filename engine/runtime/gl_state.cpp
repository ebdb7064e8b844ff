#include "engine/runtime/gl_state.h"

#include "engine/runtime/formats.h"

namespace weft::runtime {

namespace {

void setBlend(GLuint index, graph::Blend blend) {
  if (blend == graph::Blend::none) {
    glDisablei(GL_BLEND, index);
    return;
  }
  glEnablei(GL_BLEND, index);
  const bool extreme = blend == graph::Blend::min || blend == graph::Blend::max;
  glBlendEquationi(index, !extreme ? GL_FUNC_ADD : blend == graph::Blend::min ? GL_MIN : GL_MAX);
  switch (blend) {
    case graph::Blend::add: glBlendFunci(index, GL_ONE, GL_ONE); break;
    case graph::Blend::alpha:
      glBlendFuncSeparatei(index, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
      break;
    case graph::Blend::premultiplied: glBlendFunci(index, GL_ONE, GL_ONE_MINUS_SRC_ALPHA); break;
    case graph::Blend::multiply: glBlendFunci(index, GL_DST_COLOR, GL_ZERO); break;
    default: glBlendFunci(index, GL_ONE, GL_ONE); break;
  }
}

}  // namespace

void scissorTo(const PreparedPass& pass) {
  const passes::PassContext& c = pass.context;
  if (c.sliceCount == c.slices) {
    glDisable(GL_SCISSOR_TEST);
    return;
  }
  const auto at = [&](std::uint64_t slice) { return static_cast<GLint>(pass.height * slice / c.slices); };
  const GLint from = at(c.slice);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, from, static_cast<GLsizei>(pass.width), at(c.slice + c.sliceCount) - from);
}

void openMasks() {
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glStencilMask(0xff);
  glDisable(GL_SCISSOR_TEST);
}

void releaseBindings() {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glUseProgram(0);
  glBindVertexArray(0);
  glActiveTexture(GL_TEXTURE0);
  glBindTextureUnit(0, 0);
  glBindSampler(0, 0);
}

void applyState(const PreparedPass& pass) {
  const graph::StateSpec& state = pass.context.spec->state;
  bool depthAttached = false, depthWritable = false;
  for (const AttachmentBinding& attachment : pass.attachments) {
    const bool depth = attachment.point == GL_DEPTH_ATTACHMENT || attachment.point == GL_DEPTH_STENCIL_ATTACHMENT;
    depthAttached |= depth;
    depthWritable |= depth && attachment.use.access != graph::Access::read;
    if (!depth && attachment.point != GL_STENCIL_ATTACHMENT) setBlend(attachment.point - GL_COLOR_ATTACHMENT0, graph::Blend::none);
  }
  for (const auto& [index, blend] : pass.blends) setBlend(index, blend);
  glViewport(0, 0, static_cast<GLsizei>(pass.width), static_cast<GLsizei>(pass.height));
  // Writing depth needs the test enabled; a pass that writes it without asking for a test passes always.
  if (depthAttached && (state.depthTest || depthWritable)) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(state.depthTest ? glCompareOf(state.depthCompare) : GL_ALWAYS);
    glDepthMask(depthWritable && state.depthWrite ? GL_TRUE : GL_FALSE);
  } else {
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
  }
  if (state.cull == graph::Cull::none) {
    glDisable(GL_CULL_FACE);
  } else {
    glEnable(GL_CULL_FACE);
    glCullFace(state.cull == graph::Cull::back ? GL_BACK : GL_FRONT);
  }
  glPolygonMode(GL_FRONT_AND_BACK, state.lines ? GL_LINE : GL_FILL);
  if (state.offsetFactor != 0 || state.offsetUnits != 0) {
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(static_cast<GLfloat>(state.offsetFactor), static_cast<GLfloat>(state.offsetUnits));
  } else {
    glDisable(GL_POLYGON_OFFSET_FILL);
  }
}

}  // namespace weft::runtime
