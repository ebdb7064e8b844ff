// The binding and fixed-function state that the executor sets, remembered so that setting what is current issues no GL
// call. It belongs to the frame loop: forget() at its start and after foreign code (an inspector, a library that draws),
// because then nothing is known and the next call of each kind is issued. Who deletes an object
// that is bound forgets it here.
#pragma once

#include <glad/gl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

namespace weft::gl {

class StateCache {
 public:
  // Keeps the memory: a frame allocates nothing.
  void forget() {
    for (auto& slots : known_) std::ranges::fill(slots, std::nullopt);
  }

  void useProgram(GLuint program) { set(Call::program, 0, glUseProgram, program); }
  void bindTexture(GLuint unit, GLuint texture) {
    set(Call::texture, unit, glBindTextureUnit, unit, texture);
  }
  void bindSampler(GLuint unit, GLuint sampler) { set(Call::sampler, unit, glBindSampler, unit, sampler); }
  void bindImage(GLuint unit, GLuint texture, GLboolean layered, GLenum access, GLenum format) {
    set(Call::image, unit, glBindImageTexture, unit, texture, 0, layered, 0, access, format);
  }
  // `size` 0: the whole buffer. `target`: uniform or shader storage.
  void bindBuffer(GLenum target, GLuint index, GLuint buffer, GLintptr offset, GLsizeiptr size);
  // For drawing and for reading.
  void bindFramebuffer(GLuint name) { set(Call::framebuffer, 0, glBindFramebuffer, GL_FRAMEBUFFER, name); }
  void bindVertexArray(GLuint vertexArray) { set(Call::vertex_array, 0, glBindVertexArray, vertexArray); }

  // One of those in state_cache.cpp.
  void enable(GLenum capability, bool on);
  void viewport(GLint x, GLint y, GLsizei width, GLsizei height) {
    set(Call::viewport, 0, glViewport, x, y, width, height);
  }
  void scissor(GLint y, GLsizei width, GLsizei height) {
    set(Call::scissor, 0, glScissor, 0, y, width, height);
  }
  void depthFunc(GLenum compare) { set(Call::depth_func, 0, glDepthFunc, compare); }
  void depthMask(bool open) { set(Call::depth_mask, 0, glDepthMask, open ? GL_TRUE : GL_FALSE); }
  // Bits 0 to 3: red, green, blue, alpha. Of all draw buffers, or of one after that.
  void colorMask(unsigned mask) {
    set(Call::color_mask, 0, glColorMask, mask & 1, mask >> 1 & 1, mask >> 2 & 1, mask >> 3 & 1);
  }
  void colorMask(GLuint index, unsigned mask) {
    glColorMaski(index, mask & 1, mask >> 1 & 1, mask >> 2 & 1, mask >> 3 & 1);
    slotOf(Call::color_mask, 0).reset();
  }
  void stencilMask(GLuint mask) { set(Call::stencil_mask, 0, glStencilMask, mask); }
  void cullFace(GLenum face) { set(Call::cull_face, 0, glCullFace, face); }
  void polygonMode(GLenum mode) { set(Call::polygon_mode, 0, glPolygonMode, GL_FRONT_AND_BACK, mode); }
  void polygonOffset(GLfloat factor, GLfloat units) {
    set(Call::polygon_offset, 0, glPolygonOffset, factor, units);
  }
  void sampleMask(GLbitfield mask) { set(Call::sample_mask, 0, glSampleMaski, 0, mask); }
  void blendColor(const std::array<GLfloat, 4>& color) {
    set(Call::blend_color, 0, glBlendColor, color[0], color[1], color[2], color[3]);
  }
  // `face`: GL_FRONT or GL_BACK.
  void stencilTest(GLenum face, GLenum test, GLint reference, GLuint mask) {
    set(Call::stencil_test, face == GL_BACK, glStencilFuncSeparate, face, test, reference, mask);
  }
  void stencilOps(GLenum face, GLenum fail, GLenum depthFail, GLenum pass) {
    set(Call::stencil_ops, face == GL_BACK, glStencilOpSeparate, face, fail, depthFail, pass);
  }
  // The blending of one draw buffer: whether it blends; how, of colors and of alpha.
  void blend(GLuint index, bool on);
  void blendEquation(GLuint index, GLenum color, GLenum alpha) {
    set(Call::blend_equation, index, glBlendEquationSeparatei, index, color, alpha);
  }
  void blendFunction(GLuint index, GLenum source, GLenum destination, GLenum sourceAlpha,
                     GLenum destinationAlpha) {
    set(Call::blend_function, index, glBlendFuncSeparatei, index, source, destination, sourceAlpha,
        destinationAlpha);
  }

  // Opens every mask and turns the scissor off, as clears and blits need it.
  void openMasks();

 private:
  // What is set by the index of a unit, a draw buffer, a face or a capability; without one, by 0.
  // clang-format off
  enum class Call : std::uint8_t {
    program, texture, sampler, image, uniform_buffer, storage_buffer, framebuffer, vertex_array, capability, viewport,
    scissor, depth_func, depth_mask, color_mask, stencil_mask, cull_face, polygon_mode, polygon_offset, sample_mask,
    blend_color, stencil_test, stencil_ops, blend, blend_equation, blend_function, count_ };
  // clang-format on
  using Numbers = std::array<double, 7>;  // of a call; each number of GL is one
  std::optional<Numbers>& slotOf(Call call, GLuint index) {
    auto& slots = known_[static_cast<std::size_t>(call)];
    if (index >= slots.size()) slots.resize(index + 1);
    return slots[index];
  }
  // Whether the numbers are news; they are what is known from now on.
  bool takes(Call call, GLuint index, const Numbers& numbers) {
    std::optional<Numbers>& known = slotOf(call, index);
    if (known == numbers) return false;
    known = numbers;
    return true;
  }
  template <class... Arguments>
  void set(Call call, GLuint index, void (*function)(Arguments...),
           std::type_identity_t<Arguments>... arguments) {
    if (takes(call, index, Numbers{static_cast<double>(arguments)...})) function(arguments...);
  }

  std::array<std::vector<std::optional<Numbers>>, static_cast<std::size_t>(Call::count_)> known_;
};

// Binds framebuffer 0 for drawing and reading, and no program, vertex array, or texture and sampler in unit 0. A library that
// draws over the picture starts from there, so that it puts back nothing afterwards that a reload may have deleted.
void releaseBindings();

}  // namespace weft::gl
