// What passes wrote, at the place in the frame where they wrote it, read to the CPU: for commands that look at a graph
// without a person. Uses the viewer's inspector, so that both show the same.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/graph/pick/pick.h"
#include "engine/runtime/inspection/inspector.h"

namespace weft::runtime {

// One level of one layer of a texture, or a buffer, right after a step.
struct CaptureItem {
  std::uint32_t step = 0;  // into Plan::steps
  InspectTarget target;
  friend bool operator==(const CaptureItem&, const CaptureItem&) = default;
};

// Everything that each step writes of the resources whose names match one of `patterns` (graph::matchesPattern), in the order of
// steps. A pattern may be any suffix of a dotted name; one without # means all versions.
std::vector<CaptureItem> captureItems(const graph::Plan& plan, std::span<const std::string> patterns);
// What a pick names. Nothing after an error: those of graph::findPick(); or presentsUnwritten, because no live pass touches it.
std::optional<CaptureItem> captureItemOf(const graph::Plan& plan, const graph::Pick& pick,
                                         text::Diagnostics& diagnostics);

class Capture {
 public:
  explicit Capture(Device& device) : inspector_(device) {}

  // The type of a function that is called within a frame, for each item, with its index. `inspector` has the copy. Not for an
  // item whose pass has not run (FrameCadence::hasResults).
  using Visit = std::function<void(std::size_t item, Inspector& inspector)>;
  // Before a frame; holds until stop(), or until `execution` is another. There is one watch, which is this one's until then.
  void start(Execution& execution, std::vector<CaptureItem> items, Visit visit);
  void stop(Execution& execution);

 private:
  Inspector inspector_;
  std::vector<CaptureItem> items_;
  Visit visit_;
};

}  // namespace weft::runtime
