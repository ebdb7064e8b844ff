// Chooses the steps that run in a frame, by FrameCadence. Tells the cadence what each pass is made of: a hash of its program,
// uniforms and storage. Knows which steps a frame that nobody will see must still run, and which have run. A frame allocates
// nothing.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/graph/plan.h"
#include "engine/runtime/cadence/cadence.h"
#include "engine/runtime/imports/imports.h"
#include "engine/runtime/prepare/prepared_pass.h"
#include "engine/runtime/storage/resource_pool.h"
#include "engine/runtime/uniforms/frame_uniforms.h"

namespace weft::runtime {

class StepChoice {
 public:
  // All but `before` must outlive this. `passes` are those of the steps of `plan`, and remember the last run of passes of the
  // same name of the execution before, if there is one.
  StepChoice(const graph::Plan& plan, ResourcePool& pool, Imports& imports,
             const std::vector<PreparedPass>& passes, const StepChoice* before = nullptr);

  // To be called first in a frame: no step has run in it.
  void beginFrame() { std::ranges::fill(ran_, std::uint8_t{0}); }
  // Hashes anew what each pass that is not `always` is made of, besides the generations of what it reads.
  void refreshHashes(const FrameUniforms& uniforms);
  // The choice for the frame, or for a round ahead of it, as FrameCadence makes it. `generations` per resource.
  void choose(const std::vector<std::uint64_t>& generations) { cadence_.decide(hashes_, generations); }
  bool chooseAhead(const std::vector<std::uint64_t>& generations) {
    return cadence_.decideAhead(hashes_, generations);
  }

  // Whether the last choice runs the step, and which of its slices.
  bool runs(std::size_t step) const { return cadence_.runs(step); }
  SliceRange slices(std::size_t step) const { return cadence_.slices(step); }

  bool isAlways(std::size_t step) const { return plan_.passOf(step).cadence == graph::Cadence::always; }
  // Whether later frames need the step.
  bool isLasting(std::size_t step) const { return lasting_[step] != 0; }
  void markRan(std::size_t step) { ran_[step] = 1; }
  // Whether it ran in this frame, in whatever round.
  bool ran(std::size_t step) const { return ran_[step] != 0; }

  // Whether what the step writes is there, right after it or after it was skipped: it ran in this frame, or it ran earlier and
  // keeps its results. The storage of any other step holds nothing, or what another resource left in it.
  bool hasResults(std::size_t step) const {
    return ran(step) || (!isAlways(step) && cadence_.memories()[step].ran);
  }

  // To be called after the steps of a round, with the generations before and after it.
  void endRound(const std::vector<std::uint64_t>& before, const std::vector<std::uint64_t>& after) {
    cadence_.endFrame(hashes_, before, after);
  }

  // For Publications, which tells it what is published.
  FrameCadence& cadence() { return cadence_; }

 private:
  std::uint64_t hashOf(const PreparedPass& pass, const FrameUniforms& uniforms);

  const graph::Plan& plan_;
  ResourcePool& pool_;
  Imports& imports_;
  const std::vector<PreparedPass>& passes_;
  FrameCadence cadence_;
  std::vector<std::uint64_t> hashes_;        // per step
  std::vector<std::uint8_t> lasting_, ran_;  // per step
};

}  // namespace weft::runtime
