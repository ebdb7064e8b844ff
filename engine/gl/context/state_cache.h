// The binding and fixed-function state that the executor sets, remembered so that setting what is current issues no GL
// call. It belongs to the frame loop: forget() at its start and after foreign code (an inspector, a library that draws),
// because then nothing is known and the next call of each kind is issued. Who deletes an object
// that is bound forgets it here.
#pragma once

#include <glad/gl.h>

#include <array>
#include <optional>
#include <vector>

namespace weft::gl {

class StateCache {
 public:
  static constexpr std::array<GLenum, 10> kCapabilities = {
      GL_SCISSOR_TEST, GL_DEPTH_TEST,  GL_CULL_FACE,   GL_POLYGON_OFFSET_FILL,      GL_FRAMEBUFFER_SRGB,
      GL_STENCIL_TEST, GL_DEPTH_CLAMP, GL_SAMPLE_MASK, GL_SAMPLE_ALPHA_TO_COVERAGE, GL_PROGRAM_POINT_SIZE};

  void forget();

  void useProgram(GLuint program) {
    if (takes(known_.program, program)) glUseProgram(program);
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
    if (takes(known_.framebuffer, framebuffer)) glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  }
  void bindVertexArray(GLuint vertexArray) {
    if (takes(known_.vertexArray, vertexArray)) glBindVertexArray(vertexArray);
  }

  // One of kCapabilities.
  void enable(GLenum capability, bool on);
  void viewport(GLint x, GLint y, GLsizei width, GLsizei height) {
    if (takes(known_.viewport, {x, y, width, height})) glViewport(x, y, width, height);
  }
  void scissor(GLint y, GLsizei width, GLsizei height) {
    if (takes(known_.scissor, {y, width, height})) glScissor(0, y, width, height);
  }
  void depthFunc(GLenum compare) {
    if (takes(known_.depthFunc, compare)) glDepthFunc(compare);
  }
  void depthMask(bool open) {
    if (takes(known_.depthMask, open)) glDepthMask(open ? GL_TRUE : GL_FALSE);
  }
  // Bits 0 to 3: red, green, blue, alpha. Of all draw buffers, or of one after that.
  void colorMask(unsigned mask) {
    if (takes(known_.colorMask, mask)) glColorMask(mask & 1, mask >> 1 & 1, mask >> 2 & 1, mask >> 3 & 1);
  }
  void colorMask(GLuint index, unsigned mask) {
    glColorMaski(index, mask & 1, mask >> 1 & 1, mask >> 2 & 1, mask >> 3 & 1);
    known_.colorMask.reset();
  }
  void stencilMask(GLuint mask) {
    if (takes(known_.stencilMask, mask)) glStencilMask(mask);
  }
  void cullFace(GLenum face) {
    if (takes(known_.cullFace, face)) glCullFace(face);
  }
  void polygonMode(GLenum mode) {
    if (takes(known_.polygonMode, mode)) glPolygonMode(GL_FRONT_AND_BACK, mode);
  }
  void polygonOffset(GLfloat factor, GLfloat units) {
    if (takes(known_.offset, {factor, units})) glPolygonOffset(factor, units);
  }

  void sampleMask(GLbitfield mask) {
    if (takes(known_.sampleMask, mask)) glSampleMaski(0, mask);
  }
  void blendColor(const std::array<GLfloat, 4>& color) {
    if (takes(known_.blendColor, color)) glBlendColor(color[0], color[1], color[2], color[3]);
  }

  struct Stencil {
    GLenum test = GL_ALWAYS;
    GLint reference = 0;
    GLuint mask = 0xff;
    GLenum fail = GL_KEEP, depthFail = GL_KEEP, pass = GL_KEEP;
    friend bool operator==(const Stencil&, const Stencil&) = default;
  };
  void stencil(bool back, const Stencil& stencil) {
    if (!takes(known_.stencil[back ? 1 : 0], stencil)) return;
    const GLenum face = back ? GL_BACK : GL_FRONT;
    glStencilFuncSeparate(face, stencil.test, stencil.reference, stencil.mask);
    glStencilOpSeparate(face, stencil.fail, stencil.depthFail, stencil.pass);
  }

  struct Blend {
    GLenum equation = GL_FUNC_ADD, equationAlpha = GL_FUNC_ADD;
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

  struct Known {
    std::optional<GLuint> program, framebuffer, vertexArray, stencilMask;
    std::array<std::optional<bool>, kCapabilities.size()> enabled;
    std::optional<bool> depthMask;
    std::optional<unsigned> colorMask;
    std::optional<std::array<GLint, 4>> viewport;
    std::optional<GLbitfield> sampleMask;
    std::optional<std::array<GLfloat, 4>> blendColor;
    std::array<std::optional<Stencil>, 2> stencil;  // of front and back faces
    std::optional<std::array<GLint, 3>> scissor;
    std::optional<GLenum> depthFunc, cullFace, polygonMode;
    std::optional<std::array<GLfloat, 2>> offset;
  } known_;
  std::vector<std::optional<GLuint>> textures_, samplers_;
  std::vector<std::optional<Image>> images_;
  std::vector<std::optional<Range>> uniformBuffers_, storageBuffers_;
  std::vector<DrawBuffer> drawBuffers_;
};

}  // namespace weft::gl
