// Fixed-function state. Whoever draws, clears or copies sets all that it needs: nothing is remembered, so nothing leaks from one
// pass to the next.
#pragma once

#include <glad/gl.h>

namespace weft::gl {

void enable(GLenum capability, bool on);
// `size` 0: the whole buffer. `target`: uniform or shader storage.
void bindBuffer(GLenum target, GLuint index, GLuint buffer, GLintptr offset, GLsizeiptr size);

// Opens every mask and turns the scissor off, as clears and blits need it.
void openMasks();

// Binds framebuffer 0 for drawing and reading, and no program, vertex array, or texture and sampler in unit 0. A library that
// draws over the picture starts from there, so that it puts back nothing afterwards that a reload may have deleted.
void releaseBindings();

}  // namespace weft::gl
