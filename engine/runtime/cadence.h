// Which passes of a plan run in a frame: all `always` ones; `once` ones that have not run on what they write now;
// `on_change` ones whose inputs, parameters, program or storage changed since they last ran. Passes that build one
// resource together (several writers of a resource with history, or a chain of modifies) run all or none.
// Works on hashes and generation counters only. Does not: know GL, or keep anything across plans by itself; the owner
// carries PassMemory over by pass name. decide() allocates nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/graph/plan.h"

namespace weft::runtime {

// What a pass was when it last ran.
struct PassMemory {
  bool ran = false;
  std::uint64_t own = 0;                     // hash of program, parameters, storage written, imports
  std::vector<std::uint64_t> inputs;         // generation of each read use, in use order, after that frame
};

class FrameCadence {
 public:
  explicit FrameCadence(const graph::Plan& plan);

  // `own[step]` and `generations[resource]` as they are before the frame. Afterwards runs(step) answers.
  void decide(const std::vector<std::uint64_t>& own, const std::vector<std::uint64_t>& generations);
  bool runs(std::size_t step) const { return run_[step] != 0; }
  std::size_t countRunning() const;

  // To be called after the frame for each step that ran, with the generations as decide() got them and as the frame left
  // them: a pass may read a resource of which it, or a later pass, writes another part; history is what it was before.
  void remember(std::size_t step, std::uint64_t own, const std::vector<std::uint64_t>& before,
                const std::vector<std::uint64_t>& after);

  std::vector<PassMemory>& memories() { return memories_; }

 private:
  bool wants(std::size_t step, std::uint64_t own, const std::vector<std::uint64_t>& generations) const;

  const graph::Plan& plan_;
  std::vector<PassMemory> memories_;         // per step
  std::vector<std::uint32_t> setOf_;         // per step: passes of one set run together; kNone for loners
  std::vector<std::uint8_t> setRuns_;
  std::vector<std::uint8_t> run_;
  std::vector<std::uint8_t> written_;        // per resource, within decide(): a running step writes it
};

}  // namespace weft::runtime
