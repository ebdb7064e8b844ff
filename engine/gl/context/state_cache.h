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
  // A function of GL, or several of which each takes the place of the other.
  // clang-format off
  enum class Call : std::uint8_t {
    program, texture, sampler, image, uniform_buffer, storage_buffer, framebuffer, vertex_array, capability, viewport,
    scissor, depth_func, depth_mask, color_mask, stencil_mask, cull_face, polygon_mode, polygon_offset, sample_mask,
    blend_color, stencil_test, stencil_ops, blend, blend_equation, blend_function, count_ };
  // clang-format on

  // Keeps the memory: a frame allocates nothing.
  void forget() {
    for (auto& slots : known_) std::ranges::fill(slots, std::nullopt);
  }

  // Calls `function`, unless its last call had these arguments.
  template <class... Arguments>
  void set(Call call, void (*function)(Arguments...), std::type_identity_t<Arguments>... arguments) {
    if (takes(call, 0, Numbers{static_cast<double>(arguments)...})) function(arguments...);
  }
  // The same of one that sets a unit, a draw buffer or a face: its last call for `index`.
  template <class... Arguments>
  void setAt(Call call, GLuint index, void (*function)(Arguments...),
             std::type_identity_t<Arguments>... arguments) {
    if (takes(call, index, Numbers{static_cast<double>(arguments)...})) function(arguments...);
  }

  // `size` 0: the whole buffer. `target`: uniform or shader storage.
  void bindBuffer(GLenum target, GLuint index, GLuint buffer, GLintptr offset, GLsizeiptr size);
  // One of those in state_cache.cpp.
  void enable(GLenum capability, bool on);
  // Whether a draw buffer blends.
  void blend(GLuint index, bool on);
  void depthMask(bool open) { set(Call::depth_mask, glDepthMask, open ? GL_TRUE : GL_FALSE); }
  // Bits 0 to 3: red, green, blue, alpha. Of all draw buffers, or of one after that.
  void colorMask(unsigned mask) {
    set(Call::color_mask, glColorMask, mask & 1, mask >> 1 & 1, mask >> 2 & 1, mask >> 3 & 1);
  }
  void colorMask(GLuint index, unsigned mask) {
    glColorMaski(index, mask & 1, mask >> 1 & 1, mask >> 2 & 1, mask >> 3 & 1);
    slotOf(Call::color_mask, 0).reset();
  }

  // Opens every mask and turns the scissor off, as clears and blits need it.
  void openMasks();

 private:
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

  std::array<std::vector<std::optional<Numbers>>, static_cast<std::size_t>(Call::count_)> known_;
};

// Binds framebuffer 0 for drawing and reading, and no program, vertex array, or texture and sampler in unit 0. A library that
// draws over the picture starts from there, so that it puts back nothing afterwards that a reload may have deleted.
void releaseBindings();

}  // namespace weft::gl
