// The binding and fixed-function state that the executor sets, remembered so that setting what is current issues no GL
// call. It belongs to the frame loop: forget() at its start and after foreign code (an inspector, a library that draws),
// because then nothing is known and the next call of each kind is issued. Does not: ask GL for its state, or know of
// objects that are deleted while they are bound; who deletes one forgets.
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
  void forgetBuffers();

  void useProgram(GLuint program);
  void bindTexture(GLuint unit, GLuint texture);
  void bindSampler(GLuint unit, GLuint sampler);
  void bindImage(GLuint unit, GLuint texture, GLboolean layered, GLenum access, GLenum format);
  // `size` 0: the whole buffer. `target`: uniform or shader storage.
  void bindBuffer(GLenum target, GLuint index, GLuint buffer, GLintptr offset, GLsizeiptr size);
  // For drawing and for reading.
  void bindFramebuffer(GLuint framebuffer);
  void bindVertexArray(GLuint vertexArray);

  // GL_SCISSOR_TEST, GL_DEPTH_TEST, GL_CULL_FACE, GL_POLYGON_OFFSET_FILL, GL_FRAMEBUFFER_SRGB
  void enable(GLenum capability, bool on);
  void viewport(GLsizei width, GLsizei height);
  void scissor(GLint y, GLsizei width, GLsizei height);
  void depthFunc(GLenum compare);
  void depthMask(bool open);
  void colorMask(bool open);
  void stencilMask(GLuint mask);
  void cullFace(GLenum face);
  void polygonMode(GLenum mode);
  void polygonOffset(GLfloat factor, GLfloat units);

  struct Blend {
    GLenum equation = GL_FUNC_ADD;
    GLenum source = GL_ONE, destination = GL_ZERO;  // of colours
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
  template <class T>
  static std::optional<T>& slotAt(std::vector<std::optional<T>>& slots, GLuint index);

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
