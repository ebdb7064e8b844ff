// The binding and fixed-function state that the executor sets, remembered so that setting what is current issues no GL
// call. It belongs to the frame loop: forget() at its start and after foreign code (an inspector, a library that draws),
// because then nothing is known and the next call of each kind is issued. Who deletes an object
// that is bound forgets it here.
#pragma once

#include <glad/gl.h>

#include <array>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

namespace weft::gl {

class StateCache {
 public:
  static constexpr std::array<GLenum, 10> kCapabilities = {
      GL_SCISSOR_TEST, GL_DEPTH_TEST,  GL_CULL_FACE,   GL_POLYGON_OFFSET_FILL,      GL_FRAMEBUFFER_SRGB,
      GL_STENCIL_TEST, GL_DEPTH_CLAMP, GL_SAMPLE_MASK, GL_SAMPLE_ALPHA_TO_COVERAGE, GL_PROGRAM_POINT_SIZE};

  void forget();

  void useProgram(GLuint program) { set(known_.program, glUseProgram, program); }
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
  void bindFramebuffer(GLuint name) { set(known_.framebuffer, glBindFramebuffer, GL_FRAMEBUFFER, name); }
  void bindVertexArray(GLuint vertexArray) { set(known_.vertexArray, glBindVertexArray, vertexArray); }

  // One of kCapabilities.
  void enable(GLenum capability, bool on);
  void viewport(GLint x, GLint y, GLsizei width, GLsizei height) {
    set(known_.viewport, glViewport, x, y, width, height);
  }
  void scissor(GLint y, GLsizei width, GLsizei height) {
    set(known_.scissor, glScissor, 0, y, width, height);
  }
  void depthFunc(GLenum compare) { set(known_.depthFunc, glDepthFunc, compare); }
  void depthMask(bool open) { set(known_.depthMask, glDepthMask, open ? GL_TRUE : GL_FALSE); }
  // Bits 0 to 3: red, green, blue, alpha. Of all draw buffers, or of one after that.
  void colorMask(unsigned mask) {
    set(known_.colorMask, glColorMask, mask & 1, mask >> 1 & 1, mask >> 2 & 1, mask >> 3 & 1);
  }
  void colorMask(GLuint index, unsigned mask) {
    glColorMaski(index, mask & 1, mask >> 1 & 1, mask >> 2 & 1, mask >> 3 & 1);
    known_.colorMask.reset();
  }
  void stencilMask(GLuint mask) { set(known_.stencilMask, glStencilMask, mask); }
  void cullFace(GLenum face) { set(known_.cullFace, glCullFace, face); }
  void polygonMode(GLenum mode) { set(known_.polygonMode, glPolygonMode, GL_FRONT_AND_BACK, mode); }
  void polygonOffset(GLfloat factor, GLfloat units) { set(known_.offset, glPolygonOffset, factor, units); }
  void sampleMask(GLbitfield mask) { set(known_.sampleMask, glSampleMaski, 0, mask); }
  void blendColor(const std::array<GLfloat, 4>& color) {
    set(known_.blendColor, glBlendColor, color[0], color[1], color[2], color[3]);
  }

  struct Stencil {
    GLenum test = GL_ALWAYS;
    GLint reference = 0;
    GLuint mask = 0xff;
    GLenum fail = GL_KEEP, depthFail = GL_KEEP, pass = GL_KEEP;
    friend bool operator==(const Stencil&, const Stencil&) = default;
  };
  void stencil(bool back, const Stencil& stencil) {
    if (!takes(stencil_[back ? 1 : 0], stencil)) return;
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

  // Opens every mask and turns the scissor off, as clears and blits need it.
  void openMasks();

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
  using Numbers = std::array<double, 4>;  // of a call; each number of GL is one
  template <class... Arguments>
  static void set(std::optional<Numbers>& known, void (*call)(Arguments...),
                  std::type_identity_t<Arguments>... arguments) {
    if (takes(known, Numbers{static_cast<double>(arguments)...})) call(arguments...);
  }
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

  struct {  // what calls without an index have set
    std::optional<Numbers> program, framebuffer, vertexArray, viewport, scissor, depthFunc, depthMask,
        colorMask, stencilMask, cullFace, polygonMode, offset, sampleMask, blendColor;
  } known_;
  std::array<std::optional<bool>, kCapabilities.size()> enabled_;
  std::array<std::optional<Stencil>, 2> stencil_;  // of front and back faces
  std::vector<std::optional<GLuint>> textures_, samplers_;
  std::vector<std::optional<Image>> images_;
  std::vector<std::optional<Range>> uniformBuffers_, storageBuffers_;
  std::vector<DrawBuffer> drawBuffers_;
};

// Binds framebuffer 0 for drawing and reading, and no program, vertex array, or texture and sampler in unit 0. A library that
// draws over the picture starts from there, so that it puts back nothing afterwards that a reload may have deleted.
void releaseBindings();

}  // namespace weft::gl
