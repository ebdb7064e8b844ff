// Two watches over the steps of a frame (StepWatch). Records: what each pass left in what it writes, small enough to be kept beside
// a picture: a hash, so that two frames tell the first pass at which they differ, and how much is not finite. And poison.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/runtime/frame/execution.h"

namespace weft::runtime {

struct StepRecord {
  std::string pass, resource;  // full instance name; name in the graph without the number of the version
  std::uint64_t hash = 0;      // of every byte
  double broken = 0;           // share of the texels that have a NaN or an infinity
};

class StepRecorder {
 public:
  // To be called in StepWatch::before. Zeroes the buffers that the step writes anew: what it leaves out, padding and the end
  // behind the last element, is undefined, and must not be in a hash.
  void prepare(Execution& execution, std::uint32_t step);
  // To be called in StepWatch::after. No record is made of a step that has no results (FrameCadence::hasResults).
  void look(Execution& execution, std::uint32_t step);

  // The records of the steps since the last call, in their order.
  std::vector<StepRecord> take() { return std::exchange(records_, {}); }

 private:
  std::vector<StepRecord> records_;
};

// ---- poison ----
// Fills what a transient resource finds in its storage with values that no pass would write, right before the first step
// that touches it. A pass that promised to write everything and does not, or that reads what nobody wrote, then shows in the picture.

// Two patterns, because formats without NaN have no value that stands out in every picture.
enum class PoisonPattern : std::uint8_t {
  nan,    // NaN; in other formats 1, depth 1, integers of all ones
  large,  // 30000; in other formats 0, depth 0.5, integers 7
};

// To be called in StepWatch::before.
void fillWithPoison(Execution& execution, std::uint32_t step, PoisonPattern pattern);

}  // namespace weft::runtime
