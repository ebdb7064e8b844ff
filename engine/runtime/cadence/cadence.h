// Decides which passes of a plan run in a frame, and which slices of each. `always` passes run in every frame. `once`
// passes run until they have run on the storage that they write, `every` passes also in each frame whose number their period
// divides. `on_change` passes run when their inputs, parameters,
// program or storage have changed since they last ran. Of the passes of one group (plan.h) all run or none. A time-sliced
// group runs one slice of one pass per frame and starts again when something it has read changes; its owner publishes it at
// the start of the frame after its last slice. A pass that is not `always` waits while something it reads was never
// published. Works on hashes and generations only. A frame allocates nothing.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "engine/graph/plan.h"
#include "engine/runtime/storage/state_stream.h"

namespace weft::runtime {

// The state of a pass and its inputs when it last ran.
struct PassMemory {
  bool ran = false;
  std::uint64_t own = 0;              // hash of program, parameters, storage written, imports
  std::vector<std::uint64_t> inputs;  // generation of each read use, in use order, after that frame
};

// Slices [first, first + count) of `of`. A pass without slices has one.
struct SliceRange {
  std::uint32_t first = 0, count = 1, of = 1;
  bool begins() const { return first == 0; }
};

class FrameCadence {
 public:
  // `plan` must outlive this. Remembers the last run of passes of the same name of `before`, which may be null.
  explicit FrameCadence(const graph::Plan& plan, const FrameCadence* before = nullptr);

  // To be called first in a frame: no step has run in it.
  void beginFrame(std::uint32_t frame) {
    frame_ = frame;
    std::ranges::fill(ran_, std::uint8_t{0});
  }
  // Takes `own[step]` and `generations[resource]` as they are before the frame. Afterwards runs(step) and slices(step)
  // give the result. `ahead`: of decideAhead().
  void decide(const std::vector<std::uint64_t>& own, const std::vector<std::uint64_t>& generations,
              bool ahead = false);
  // Decides a round ahead of the frame, in which time-sliced groups run whole. Of the other passes only those run that are
  // not `always` and that a group may wait for. False, and nothing runs, when no time-sliced group has to.
  bool decideAhead(const std::vector<std::uint64_t>& own, const std::vector<std::uint64_t>& generations);
  bool runs(std::size_t step) const { return run_[step] != 0; }
  SliceRange slices(std::size_t step) const { return slices_[step]; }

  bool isAlways(std::size_t step) const { return plan_.passOf(step).cadence == graph::Cadence::always; }
  void markRan(std::size_t step) { ran_[step] = 1; }
  // Whether it ran in this frame, in whatever round.
  bool ran(std::size_t step) const { return ran_[step] != 0; }
  // Whether what the step writes is there, right after it or after it was skipped: it ran in this frame, or it ran earlier and
  // keeps its results. The storage of any other step holds nothing, or what another resource left in it.
  bool hasResults(std::size_t step) const { return ran(step) || (!isAlways(step) && memories_[step].ran); }

  // To be called after the frame, with the generations that decide() got and those after the frame. Both are needed,
  // because a pass may read a resource of which it, or a later pass, writes another part, and because a pass that reads
  // history has read what was there before the frame.
  void endFrame(const std::vector<std::uint64_t>& own, const std::vector<std::uint64_t>& before,
                const std::vector<std::uint64_t>& after);

  // A time-sliced group is finished when its last slice has run. The owner then rotates its resources, raises their
  // generations and calls markPublished(). Until then the group counts as running.
  bool isFinished(std::uint32_t group) const { return groups_[group].finished; }
  void markPublished(std::uint32_t group);
  // Marks the group as published, for a plan that takes over storage which already holds a publication of it.
  void restorePublished(std::uint32_t group) { groups_[group].published = true; }

  // Saves or restores what ran, between two frames. What is of this process only: `own` per step, a term of its hash, and
  // `importOf(resource)`, the generation of an import.
  void carry(StateStream& state, std::span<const std::uint64_t> own,
             const std::function<std::optional<std::uint64_t>(std::uint32_t)>& importOf);

 private:
  struct Group {
    std::vector<std::uint32_t> steps;  // in plan order
    bool sliced = false;
    bool wants = false, blocked = false;  // within decide()
    bool active = false, finished = false, published = false, started = false;
    std::uint32_t at = 0, slice = 0;  // the next turn: index into steps, slice
  };
  bool differs(std::size_t step, const PassMemory& memory, bool inputs, const std::vector<std::uint64_t>& own,
               const std::vector<std::uint64_t>& generations) const;
  bool wants(std::size_t step, const std::vector<std::uint64_t>& own,
             const std::vector<std::uint64_t>& generations) const;
  bool isInside(std::size_t step, std::uint32_t resource) const;
  bool sweep(bool ahead);
  void takeTurn(Group& group, bool whole);
  void take(std::size_t step, PassMemory& memory, std::uint64_t own, const std::vector<std::uint64_t>& before,
            const std::vector<std::uint64_t>& after) const;

  const graph::Plan& plan_;
  std::uint32_t frame_ = 0;
  std::vector<PassMemory> memories_, latches_;  // per step; latches: of inputs, when a sliced group began
  std::vector<std::uint32_t> groupOf_;          // per step, kNone
  std::vector<Group> groups_;
  std::vector<SliceRange> slices_;
  std::vector<std::uint8_t> run_, wants_, ran_;  // per step
  std::vector<std::uint8_t> written_, blocked_;  // per resource, in decide(): by a running step; not there
  std::vector<std::uint8_t> alwaysWritten_;      // per resource
};

}  // namespace weft::runtime
