// Fixed-function state of a pass, set whole before each pass so that nothing leaks from one to the next.
#pragma once

#include "engine/runtime/prepared_pass.h"

namespace weft::runtime {

void applyState(const PreparedPass& pass);
// What clears and blits rely on: every mask open, scissor off.
void openMasks();

}  // namespace weft::runtime
