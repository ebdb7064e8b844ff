// Fixed-function state of a pass, set whole before each pass so that nothing leaks from one to the next.
#pragma once

#include "engine/runtime/prepared_pass.h"

namespace weft::runtime {

void applyState(const PreparedPass& pass);
// Confines rendering to the rows of the pass's slices; off for a pass that runs whole.
void scissorTo(const PreparedPass& pass);
// What clears and blits rely on: every mask open, scissor off.
void openMasks();

// Framebuffer 0 bound for drawing and reading, and no program, vertex array, texture or sampler in unit 0: where a library
// that draws over the picture starts, so that what it puts back afterwards is nothing that a reload may have deleted.
void releaseBindings();

}  // namespace weft::runtime
