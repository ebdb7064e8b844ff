#include "engine/runtime/frame/gl_state.h"

#include "engine/runtime/storage/formats.h"

namespace weft::runtime {

namespace {

std::optional<gl::StateCache::Blend> blendOf(graph::Blend blend) {
  switch (blend) {
    case graph::Blend::none:
      return std::nullopt;
    case graph::Blend::add:
      return {{GL_FUNC_ADD, GL_ONE, GL_ONE, GL_ONE, GL_ONE}};
    case graph::Blend::alpha:
      return {{GL_FUNC_ADD, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA}};
    case graph::Blend::premultiplied:
      return {{GL_FUNC_ADD, GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA}};
    case graph::Blend::multiply:
      return {{GL_FUNC_ADD, GL_DST_COLOR, GL_ZERO, GL_DST_COLOR, GL_ZERO}};
    case graph::Blend::min:
      return {{GL_MIN, GL_ONE, GL_ONE, GL_ONE, GL_ONE}};
    case graph::Blend::max:
      return {{GL_MAX, GL_ONE, GL_ONE, GL_ONE, GL_ONE}};
  }
  return std::nullopt;
}

}  // namespace

void scissorTo(const PreparedPass& pass, gl::StateCache& states) {
  const passes::PassContext& c = pass.context;
  const bool confined = c.sliceCount != c.slices;
  states.enable(GL_SCISSOR_TEST, confined);
  if (!confined) return;
  const auto at = [&](std::uint64_t slice) { return static_cast<GLint>(pass.height * slice / c.slices); };
  const GLint from = at(c.slice);
  states.scissor(from, static_cast<GLsizei>(pass.width), at(c.slice + c.sliceCount) - from);
}

void openMasks(gl::StateCache& states) {
  states.colorMask(true);
  states.depthMask(true);
  states.stencilMask(0xff);
  states.enable(GL_SCISSOR_TEST, false);
  states.enable(GL_FRAMEBUFFER_SRGB, false);  // clears and copies do not convert
}

void openMasks() {
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glStencilMask(0xff);
  glDisable(GL_SCISSOR_TEST);
}

GLenum attachmentPointOf(GLenum format) {
  const gl::FormatClass kind = gl::classOf(format);
  return kind == gl::FormatClass::depth           ? GL_DEPTH_ATTACHMENT
         : kind == gl::FormatClass::depth_stencil ? GL_DEPTH_STENCIL_ATTACHMENT
                                                  : GL_COLOR_ATTACHMENT0;
}

bool resolveSamples(const gl::TextureRef& from, GLuint to) {
  base::Diagnostics ignored;
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

void applyState(const PreparedPass& pass, gl::StateCache& states) {
  const graph::StateSpec& state = pass.context.spec->state;
  bool depthAttached = false, depthWritable = false;
  for (const AttachmentBinding& attachment : pass.attachments) {
    const bool depth =
        attachment.point == GL_DEPTH_ATTACHMENT || attachment.point == GL_DEPTH_STENCIL_ATTACHMENT;
    depthAttached |= depth;
    depthWritable |= depth && attachment.use.access != graph::Access::read;
    if (depth || attachment.point == GL_STENCIL_ATTACHMENT) continue;
    const GLuint index = attachment.point - GL_COLOR_ATTACHMENT0;
    graph::Blend mode = graph::Blend::none;
    for (const auto& [buffer, blend] : pass.blends)
      if (buffer == index) mode = blend;
    states.blend(index, blendOf(mode));
  }
  states.enable(GL_FRAMEBUFFER_SRGB, pass.encodesSrgb);
  states.viewport(static_cast<GLsizei>(pass.width), static_cast<GLsizei>(pass.height));
  const bool depthTest = depthAttached && state.depthTest;
  states.enable(GL_DEPTH_TEST, depthTest);
  if (depthTest) states.depthFunc(glCompareOf(state.depthCompare));
  states.depthMask(depthTest && depthWritable && state.depthWrite);
  states.colorMask(pass.writesColor);
  states.enable(GL_CULL_FACE, state.cull != graph::Cull::none);
  if (state.cull != graph::Cull::none) states.cullFace(state.cull == graph::Cull::back ? GL_BACK : GL_FRONT);
  states.polygonMode(state.lines ? GL_LINE : GL_FILL);
  const bool offset = state.offsetFactor != 0 || state.offsetUnits != 0;
  states.enable(GL_POLYGON_OFFSET_FILL, offset);
  if (offset)
    states.polygonOffset(static_cast<GLfloat>(state.offsetFactor), static_cast<GLfloat>(state.offsetUnits));
}

}  // namespace weft::runtime
