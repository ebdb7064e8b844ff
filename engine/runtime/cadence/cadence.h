// Which passes of a plan run in a frame, and which part of each: all `always` ones; `once` ones that have not
// run on what they write now; `on_change` ones whose inputs, parameters, program or storage changed since
// they last ran. Passes of one group (plan.h) run all or none. A time-sliced group does one slice of one pass per
// frame, starts again when something it saw changes, and is published by the owner at the start of the frame
// after its last slice. A pass that is not `always` waits while something it reads was never published, or
// while the owner holds it, so that it publishes nothing. Works on hashes and generation counters only. Does
// not: know GL, or keep anything across plans by itself; the owner carries PassMemory over by pass name.
// decide() allocates nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/graph/plan.h"

namespace weft::runtime {

// What a pass was when it last ran.
struct PassMemory {
  bool ran = false;
  std::uint64_t own = 0;              // hash of program, parameters, storage written, imports
  std::vector<std::uint64_t> inputs;  // generation of each read use, in use order, after that frame
};

// Slices [first, first + count) of `of`; all of a pass that is not sliced.
struct SliceRange {
  std::uint32_t first = 0, count = 1, of = 1;
  bool begins() const { return first == 0; }
  friend bool operator==(const SliceRange&, const SliceRange&) = default;
};

class FrameCadence {
 public:
  explicit FrameCadence(const graph::Plan& plan);

  // `own[step]` and `generations[resource]` as they are before the frame. Afterwards runs(step) and
  // slices(step) answer.
  void decide(const std::vector<std::uint64_t>& own, const std::vector<std::uint64_t>& generations);
  // The same for a round ahead of the frame, in which time-sliced groups run whole: of the other passes only those
  // that groups may wait for run, none that is `always`. Nothing runs when no time-sliced group does; then false.
  bool decideAhead(const std::vector<std::uint64_t>& own, const std::vector<std::uint64_t>& generations);
  bool runs(std::size_t step) const { return run_[step] != 0; }
  SliceRange slices(std::size_t step) const { return slices_[step]; }
  std::size_t countRunning() const;

  // After the frame, with the generations as decide() got them and as the frame left them: a pass may read a
  // resource of which it, or a later pass, writes another part; history is what it was before.
  void endFrame(const std::vector<std::uint64_t>& own, const std::vector<std::uint64_t>& before,
                const std::vector<std::uint64_t>& after);

  // Time-sliced groups whose last slice has run wait here until the owner publishes them: turns their resources,
  // moves their generations, and says so.
  // Between the two it counts as under way.
  bool isFinished(std::uint32_t group) const { return groups_[group].finished; }
  void markPublished(std::uint32_t group);
  // For a plan that takes over storage: what the group writes holds a publication.
  void restorePublished(std::uint32_t group) { groups_[group].published = true; }
  bool isPublished(std::uint32_t group) const { return groups_[group].published; }

  // Per step, the owner's to change: one that is not `always` and held does not run; nor does its group, unless
  // that is time-sliced: then the owner is to leave it finished.
  std::vector<std::uint8_t>& held() { return held_; }
  bool isHeld(std::uint32_t group) const;

  std::vector<PassMemory>& memories() { return memories_; }

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
      latches_;  // per step; latches: what a time-sliced group that is under way has seen
  std::vector<std::uint32_t> groupOf_;  // per step, kNone
  std::vector<Group> groups_;
  std::vector<SliceRange> slices_;
  std::vector<std::uint8_t> run_, wants_, held_;  // per step
  std::vector<std::uint8_t> written_,
      blocked_;  // per resource, within decide(): a running step writes it; it is not there
  std::vector<std::uint8_t> alwaysWritten_;  // per resource
};

}  // namespace weft::runtime
