// The binding and fixed-function state that the executor sets, remembered so that setting what is current issues no GL
// call. It belongs to the frame loop: forget() at its start and after foreign code (an inspector, a library that draws),
// because then nothing is known and the next call of each kind is issued. Who deletes an object
// that is bound forgets it here.
#pragma once

#include <glad/gl.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace weft::gl {

class StateCache {
 public:
  void forget();

  void useProgram(GLuint program) {
    if (takes(program_, program)) glUseProgram(program);
  }
  void bindTexture(GLuint unit, GLuint texture) {
    if (takes(slotAt(textures_, unit), texture)) glBindTextureUnit(unit, texture);
  }
  void bindSampler(GLuint unit, GLuint sampler) {
    if (takes(slotAt(samplers_, unit), sampler)) glBindSampler(unit, sampler);
  }
  void bindImage(GLuint unit, GLuint texture, GLboolean layered, GLenum access, GLenum format) {
    if (takes(slotAt(images_, unit), Image{texture, layered, access, format}))
      glBindImageTexture(unit, texture, 0, layered, 0, access, format);
  }
  // `size` 0: the whole buffer. `target`: uniform or shader storage.
  void bindBuffer(GLenum target, GLuint index, GLuint buffer, GLintptr offset, GLsizeiptr size);
  // For drawing and for reading.
  void bindFramebuffer(GLuint framebuffer) {
    if (takes(framebuffer_, framebuffer)) glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  }
  void bindVertexArray(GLuint vertexArray) {
    if (takes(vertexArray_, vertexArray)) glBindVertexArray(vertexArray);
  }

  // GL_SCISSOR_TEST, GL_DEPTH_TEST, GL_CULL_FACE, GL_POLYGON_OFFSET_FILL, GL_FRAMEBUFFER_SRGB
  void enable(GLenum capability, bool on);
  void viewport(GLsizei width, GLsizei height) {
    if (takes(viewport_, {width, height})) glViewport(0, 0, width, height);
  }
  void scissor(GLint y, GLsizei width, GLsizei height) {
    if (takes(scissor_, {y, width, height})) glScissor(0, y, width, height);
  }
  void depthFunc(GLenum compare) {
    if (takes(depthFunc_, compare)) glDepthFunc(compare);
  }
  void depthMask(bool open) {
    if (takes(depthMask_, open)) glDepthMask(open ? GL_TRUE : GL_FALSE);
  }
  void colorMask(bool open) {
    const GLboolean mask = open ? GL_TRUE : GL_FALSE;
    if (takes(colorMask_, open)) glColorMask(mask, mask, mask, mask);
  }
  void stencilMask(GLuint mask) {
    if (takes(stencilMask_, mask)) glStencilMask(mask);
  }
  void cullFace(GLenum face) {
    if (takes(cullFace_, face)) glCullFace(face);
  }
  void polygonMode(GLenum mode) {
    if (takes(polygonMode_, mode)) glPolygonMode(GL_FRONT_AND_BACK, mode);
  }
  void polygonOffset(GLfloat factor, GLfloat units) {
    if (takes(offset_, {factor, units})) glPolygonOffset(factor, units);
  }

  struct Blend {
    GLenum equation = GL_FUNC_ADD;
    GLenum source = GL_ONE, destination = GL_ZERO;  // of colors
    GLenum sourceAlpha = GL_ONE, destinationAlpha = GL_ZERO;
    friend bool operator==(const Blend&, const Blend&) = default;
  };
  // Sets the blending of one draw buffer; without `mode` it does not blend.
  void blend(GLuint index, const std::optional<Blend>& mode);

 private:
  struct Image {
    GLuint texture;
    GLboolean layered;
    GLenum access, format;
    friend bool operator==(const Image&, const Image&) = default;
  };
  struct Range {
    GLuint buffer;
    GLintptr offset;
    GLsizeiptr size;
    friend bool operator==(const Range&, const Range&) = default;
  };
  struct DrawBuffer {
    std::optional<bool> on;
    std::optional<Blend> mode;
  };
  // Whether `value` is news; it is what is known from now on.
  template <class T>
  static bool takes(std::optional<T>& known, const T& value) {
    if (known == value) return false;
    known = value;
    return true;
  }
  template <class T>
  static std::optional<T>& slotAt(std::vector<std::optional<T>>& slots, GLuint index) {
    if (index >= slots.size()) slots.resize(index + 1);
    return slots[index];
  }

  std::optional<GLuint> program_, framebuffer_, vertexArray_, stencilMask_;
  std::vector<std::optional<GLuint>> textures_, samplers_;
  std::vector<std::optional<Image>> images_;
  std::vector<std::optional<Range>> uniformBuffers_, storageBuffers_;
  std::optional<bool> scissorTest_, depthTest_, cull_, srgb_, offsetFill_, depthMask_, colorMask_;
  std::optional<std::array<GLsizei, 2>> viewport_;
  std::optional<std::array<GLint, 3>> scissor_;
  std::optional<GLenum> depthFunc_, cullFace_, polygonMode_;
  std::optional<std::array<GLfloat, 2>> offset_;
  std::vector<DrawBuffer> drawBuffers_;
};

}  // namespace weft::gl
