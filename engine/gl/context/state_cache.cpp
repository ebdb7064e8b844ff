#include "engine/gl/context/state_cache.h"

#include <algorithm>
#include <cassert>

namespace weft::gl {

namespace {

// Whether `value` is news; it is what is known from now on.
template <class T>
bool takes(std::optional<T>& known, const T& value) {
  if (known == value) return false;
  known = value;
  return true;
}

}  // namespace

template <class T>
std::optional<T>& StateCache::slotAt(std::vector<std::optional<T>>& slots, GLuint index) {
  if (index >= slots.size()) slots.resize(index + 1);
  return slots[index];
}

// Keeps the vectors' memory: a frame allocates nothing.
void StateCache::forget() {
  program_ = framebuffer_ = vertexArray_ = stencilMask_ = std::nullopt;
  std::ranges::fill(textures_, std::nullopt);
  std::ranges::fill(samplers_, std::nullopt);
  std::ranges::fill(images_, std::nullopt);
  forgetBuffers();
  scissorTest_ = depthTest_ = cull_ = srgb_ = offsetFill_ = depthMask_ = colorMask_ = std::nullopt;
  viewport_ = std::nullopt;
  scissor_ = std::nullopt;
  depthFunc_ = cullFace_ = polygonMode_ = std::nullopt;
  offset_ = std::nullopt;
  std::ranges::fill(drawBuffers_, DrawBuffer{});
}

void StateCache::forgetBuffers() {
  std::ranges::fill(uniformBuffers_, std::nullopt);
  std::ranges::fill(storageBuffers_, std::nullopt);
}

void StateCache::useProgram(GLuint program) {
  if (takes(program_, program)) glUseProgram(program);
}

void StateCache::bindTexture(GLuint unit, GLuint texture) {
  if (takes(slotAt(textures_, unit), texture)) glBindTextureUnit(unit, texture);
}

void StateCache::bindSampler(GLuint unit, GLuint sampler) {
  if (takes(slotAt(samplers_, unit), sampler)) glBindSampler(unit, sampler);
}

void StateCache::bindImage(GLuint unit, GLuint texture, GLboolean layered, GLenum access, GLenum format) {
  if (takes(slotAt(images_, unit), Image{texture, layered, access, format}))
    glBindImageTexture(unit, texture, 0, layered, 0, access, format);
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

void StateCache::bindFramebuffer(GLuint framebuffer) {
  if (takes(framebuffer_, framebuffer)) glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

void StateCache::bindVertexArray(GLuint vertexArray) {
  if (takes(vertexArray_, vertexArray)) glBindVertexArray(vertexArray);
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

void StateCache::viewport(GLsizei width, GLsizei height) {
  if (takes(viewport_, {width, height})) glViewport(0, 0, width, height);
}

void StateCache::scissor(GLint y, GLsizei width, GLsizei height) {
  if (takes(scissor_, {y, width, height})) glScissor(0, y, width, height);
}

void StateCache::depthFunc(GLenum compare) {
  if (takes(depthFunc_, compare)) glDepthFunc(compare);
}

void StateCache::depthMask(bool open) {
  if (takes(depthMask_, open)) glDepthMask(open ? GL_TRUE : GL_FALSE);
}

void StateCache::colorMask(bool open) {
  const GLboolean mask = open ? GL_TRUE : GL_FALSE;
  if (takes(colorMask_, open)) glColorMask(mask, mask, mask, mask);
}

void StateCache::stencilMask(GLuint mask) {
  if (takes(stencilMask_, mask)) glStencilMask(mask);
}

void StateCache::cullFace(GLenum face) {
  if (takes(cullFace_, face)) glCullFace(face);
}

void StateCache::polygonMode(GLenum mode) {
  if (takes(polygonMode_, mode)) glPolygonMode(GL_FRONT_AND_BACK, mode);
}

void StateCache::polygonOffset(GLfloat factor, GLfloat units) {
  if (takes(offset_, {factor, units})) glPolygonOffset(factor, units);
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
