// Fixed-function state of a pass, set whole before each pass so that nothing leaks from one to the next.
#pragma once

#include "engine/gl/context/state_cache.h"
#include "engine/runtime/prepare/prepared_pass.h"

namespace weft::runtime {

void applyState(const PreparedPass& pass, gl::StateCache& states);
// Confines rendering to the rows of the pass's slices; off for a pass that runs whole.
void scissorTo(const PreparedPass& pass, gl::StateCache& states);
// What clears and blits rely on: every mask open, scissor off.
void openMasks(gl::StateCache& states);
// The same outside the frame loop, where nothing is known of the state.
void openMasks();

// Framebuffer 0 bound for drawing and reading, and no program, vertex array, texture or sampler in unit 0: where a library
// that draws over the picture starts, so that what it puts back afterwards is nothing that a reload may have deleted.
void releaseBindings();

}  // namespace weft::runtime
