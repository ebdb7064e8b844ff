// Decides which passes of a plan run in a frame, and which slices of each. `always` passes run in every frame. `once`
// passes run until they have run on the storage that they write. `on_change` passes run when their inputs, parameters,
// program or storage have changed since they last ran. Of the passes of one group (plan.h) all run or none. A time-sliced
// group runs one slice of one pass per frame and starts again when something it has read changes; its owner publishes it at
// the start of the frame after its last slice. A pass that is not `always` waits while something it reads was never
// published. Works on hashes and generations only.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/graph/plan.h"

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
  friend bool operator==(const SliceRange&, const SliceRange&) = default;
};

class FrameCadence {
 public:
  explicit FrameCadence(const graph::Plan& plan);

  // Takes `own[step]` and `generations[resource]` as they are before the frame. Afterwards runs(step) and slices(step)
  // give the result.
  void decide(const std::vector<std::uint64_t>& own, const std::vector<std::uint64_t>& generations);
  // Decides a round ahead of the frame, in which time-sliced groups run whole. Of the other passes only those run that are
  // not `always` and that a group may wait for. False, and nothing runs, when no time-sliced group has to.
  bool decideAhead(const std::vector<std::uint64_t>& own, const std::vector<std::uint64_t>& generations);
  bool runs(std::size_t step) const { return run_[step] != 0; }
  SliceRange slices(std::size_t step) const { return slices_[step]; }
  std::size_t countRunning() const;

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
  bool isPublished(std::uint32_t group) const { return groups_[group].published; }

  std::vector<PassMemory>& memories() { return memories_; }
  const std::vector<PassMemory>& memories() const { return memories_; }

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
  void settle(const std::vector<std::uint64_t>& own, const std::vector<std::uint64_t>& generations,
              bool ahead);
  bool sweep(bool ahead);
  void takeTurn(Group& group, bool whole);
  void take(std::size_t step, PassMemory& memory, std::uint64_t own, const std::vector<std::uint64_t>& before,
            const std::vector<std::uint64_t>& after) const;

  const graph::Plan& plan_;
  std::vector<PassMemory> memories_,
      latches_;                         // per step; latches: the inputs with which a time-sliced group began
  std::vector<std::uint32_t> groupOf_;  // per step, kNone
  std::vector<Group> groups_;
  std::vector<SliceRange> slices_;
  std::vector<std::uint8_t> run_, wants_;  // per step
  std::vector<std::uint8_t> written_,
      blocked_;  // per resource, within decide(): a running step writes it; it is not there
  std::vector<std::uint8_t> alwaysWritten_;  // per resource
};

// Per resource: a history that only `always` passes write, so that it is made anew in each frame.
std::vector<std::uint8_t> findFrameHistories(const graph::Plan& plan);

// Per step: later frames depend on it even when nobody sees this one. Its results are kept, it is a slice, or one of those
// needs what it makes. The other steps serve only the picture of their frame: they may be left out of a frame that is
// dropped, whose histories go back to what they were before it. What is read back for display does not count.
std::vector<std::uint8_t> findLastingSteps(const graph::Plan& plan);

}  // namespace weft::runtime
