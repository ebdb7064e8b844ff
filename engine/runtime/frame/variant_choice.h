// Chooses the variant of each conditional pass in a frame. Dynamic defines depend on ages, so a pass may be prepared in
// several variants; those that the frame does not use are parked. Does not: know what the conditions mean.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/graph/plan.h"
#include "engine/runtime/frame/device.h"
#include "engine/runtime/prepare/prepared_pass.h"

namespace weft::runtime {

class VariantChoice {
 public:
  // All must outlive this. `passes` has the running variant of each step.
  VariantChoice(const graph::Plan& plan, Device& device, ResourcePool& pool,
                std::vector<PreparedPass>& passes)
      : plan_(plan), device_(device), pool_(pool), passes_(passes) {}

  // Puts the variants in place that the ages ask for, of all passes or only of `always` ones. True when a variant was
  // prepared for the first time, whose uniforms have no place yet. A variant that does not compile is reported once, and
  // the pass keeps the one it has.
  bool choose(const std::function<double(std::uint32_t)>& ageOf, bool alwaysOnly,
              base::Diagnostics& diagnostics);
  // All prepared passes, running and parked, until the next choose(). Allocates only after a new one was prepared.
  std::span<PreparedPass* const> all();

 private:
  struct Parked {
    std::size_t step = 0;
    PreparedPass pass;
  };
  bool take(std::size_t step, std::uint32_t conditions, base::Diagnostics& diagnostics);

  const graph::Plan& plan_;
  Device& device_;
  ResourcePool& pool_;
  std::vector<PreparedPass>& passes_;
  std::vector<Parked> parked_;
  std::vector<PreparedPass*> all_;
};

}  // namespace weft::runtime
