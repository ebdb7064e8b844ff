// Functions that are called around the steps of a frame while it runs, to look at results. An empty watch costs nothing.
// Does not: know what they look at (engine/runtime/inspection does).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "engine/graph/flat_graph.h"

namespace weft::runtime {

// `before` is called right before a step that runs, when its barriers are issued and its clears are not yet made; `after`
// right after a step, also when it was skipped, while its results are still in their storage (later steps may put other
// resources there). Both may read, copy and draw into textures of their own; they do not change the plan or what runs.
struct StepWatch {
  using Look = std::function<void(std::uint32_t step)>;
  Look before{}, after{};
  std::uint32_t only = graph::kNone;  // the one step that is watched; kNone: each

  bool isSet() const { return before || after; }
  // Calls the function if it watches the step. True when it did: then other GL state may be set.
  bool lookBefore(std::size_t step) const { return look(before, step); }
  bool lookAfter(std::size_t step) const { return look(after, step); }

 private:
  bool look(const Look& function, std::size_t step) const {
    if (!function || (only != graph::kNone && step != only)) return false;
    function(static_cast<std::uint32_t>(step));
    return true;
  }
};

}  // namespace weft::runtime
