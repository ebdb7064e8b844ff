// Finds the passes of a new plan that are equal to passes of the running plan, so that what was prepared for those
// (program, bindings, views, attachments) can be kept. Passes are matched by their instance names, resources by the
// slots that use them. Compares descriptions and the identity of storage only. Shader files and values of
// uniforms, which are written anew, do not count.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/graph/plan.h"
#include "engine/runtime/prepare/prepared_pass.h"
#include "engine/runtime/storage/resource_pool.h"

namespace weft::runtime {

class PassKeeper {
 public:
  // Both plans must outlive this.
  PassKeeper(const graph::Plan& plan, const graph::Plan& before);

  // The step of the running plan with the name of `step`, or kNone.
  std::uint32_t stepBefore(std::size_t step) const { return stepsBefore_[step]; }
  // Whether everything that the program is made of, and is checked against, is the same. `old`: stepBefore(step).
  bool isSame(std::size_t step, std::uint32_t old);
  // Whether the two steps also use the same storage. isSame() must hold.
  bool isInPlace(std::size_t step, std::uint32_t old, const ResourcePool& pool,
                 const ResourcePool& poolBefore) const;
  // What was prepared for `old`, for `step`. isSame() and isInPlace() must hold.
  PreparedPass keep(std::size_t step, std::uint32_t old, PreparedPass prepared);

 private:
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  // resources: before, now
  // Fills pairs_. False when a resource of the running plan would be two in the new plan, or two would be one.
  bool pairUp(std::size_t step, std::uint32_t old);

  const graph::Plan &plan_, &before_;
  std::vector<std::uint32_t> stepsBefore_;  // by step; kNone: there is none
  Pairs pairs_;                             // of the step that pairUp() was last called for
};

}  // namespace weft::runtime
