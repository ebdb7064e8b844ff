// Why a plan is as it is: why a pass runs or was culled, why a barrier has its bits, why two textures share.
// Computed when asked, from the plan alone; compile() keeps none of it. Sentences are for people and stable
// for equal plans.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/graph/compile/dependencies.h"
#include "engine/graph/plan.h"

namespace weft::graph {

// One access of the two that make a barrier bit necessary.
struct Touch {
  std::uint32_t pass = kNone;  // kNone: present or read-back at the end of the frame
  FlatUse use;
  bool clear = false;           // the clear before the pass
  std::uint32_t framesAgo = 0;  // 0: in the frame of the barrier
};

struct BarrierReason {
  std::uint32_t step = 0;  // steps.size(): at the end of the frame
  bool afterClears = false;
  BarrierBit bit{};
  bool found = false;   // false: only frames in which some pass is skipped need the bit (barrier_rules.h)
  Touch before, after;  // the accesses that the barrier separates
};

class Explainer {
 public:
  // `plan` must outlive the explainer.
  explicit Explainer(const Plan& plan);

  // "runs: 'composite' reads 'hdr'" / "culled: nobody reads 'velocity'" …
  std::string whyPass(std::uint32_t pass) const;
  // "after 'sky' (reads 'hdr'), 'sort' (reads 'keys')": what must run before it, "" when nothing
  std::string whyHere(std::uint32_t pass) const;
  // "storage 3, shared with 'a' (steps 0..2)" / "storage of its own: history of 1" …
  std::string whyStorage(std::uint32_t resource) const;
  // One reason per bit, in order of steps and bits.
  std::vector<BarrierReason> whyBarriers() const;
  std::string textOf(const BarrierReason& reason) const;

 private:
  bool touchesSameMemory(const Touch& a, std::int64_t frameA, const Touch& b, std::int64_t frameB) const;
  template <class F>
  bool eachAccess(std::uint32_t step, F&& f) const;
  std::string textOf(const Touch& touch) const;

  const Plan& plan_;
  const FlatGraph& graph_;
  std::vector<Dependency> edges_;                 // over all passes, read after write and the others
  std::vector<std::vector<std::uint32_t>> from_;  // per pass: edges that leave it
  std::vector<std::vector<std::uint32_t>> to_;    // per pass: edges that reach it
};

// "hdr.mip[2]", "maps.layer[0..3]", "depth.stencil", "taa@-1": a use as a person would write it.
std::string textOf(const FlatGraph& graph, const FlatUse& use);
// "texture_fetch image_access"
std::string barrierText(std::uint16_t mask);

}  // namespace weft::graph
