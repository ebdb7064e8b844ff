// Fills what a transient resource finds in its storage with values that no pass would write, right before the first step
// that touches it. A pass that promised to write everything and does not, or that reads what nobody wrote, then shows in
// the picture.
#pragma once

#include <cstdint>

#include "engine/runtime/frame/execution.h"

namespace weft::runtime {

// Two patterns, because formats without NaN have no value that stands out in every picture.
enum class PoisonPattern : std::uint8_t {
  nan,    // NaN; in other formats 1, depth 1, integers of all ones
  large,  // 30000; in other formats 0, depth 0.5, integers 7
};

// To be called in StepWatch::before.
void fillWithPoison(Execution& execution, std::uint32_t step, PoisonPattern pattern);

}  // namespace weft::runtime
