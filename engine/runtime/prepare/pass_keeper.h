// Which passes of a new plan are what passes of the running one are, so that what was prepared for those
// serves again: program, bindings, views, attachments. Passes meet by their instance names, resources by the
// slots that use them. Reads descriptions and storage identities only. Does not: compare shader files, or
// values of uniforms, which are written anew.
#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>
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
  std::uint32_t stepBefore(std::size_t step) const;
  // Whether everything that a program is made of and held against is the same.
  bool isSame(std::size_t step, std::uint32_t old) const;
  // Whether what the steps touch lies in the same storage as well. isSame() must hold.
  bool isInPlace(std::size_t step, std::uint32_t old, ResourcePool& pool, ResourcePool& poolBefore) const;
  // `prepared` of `old` as that of `step`. isSame() and isInPlace() must hold.
  PreparedPass take(std::size_t step, std::uint32_t old, PreparedPass prepared) const;

 private:
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  // resources: before, now
  const graph::Value* clearOf(const std::unordered_map<std::uint32_t, const graph::Value*>& clears,
                              std::uint32_t resource) const;
  // False when one resource before would be two now, or two one.
  bool pairUp(std::size_t step, std::uint32_t old, Pairs& pairs) const;

  const graph::Plan &plan_, &before_;
  std::unordered_map<std::string_view, std::uint32_t> stepOf_;  // of the running plan
  std::unordered_map<std::uint32_t, const graph::Value*> clears_, clearsBefore_;
};

}  // namespace weft::runtime
