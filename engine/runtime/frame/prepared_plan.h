// A plan that can run on a device: its storage, and for each step what runs it. A new plan is prepared beside the one that
// runs, and shares with it storage that fits and passes that are the same.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/graph/plan.h"
#include "engine/runtime/frame/device.h"
#include "engine/runtime/prepare/prepared_pass.h"
#include "engine/runtime/storage/resource_pool.h"
#include "engine/text/diagnostic.h"

namespace weft::runtime {

// Whether shader files are read again for passes that do not change.
enum class ShaderFiles : std::uint8_t { read, keep };

struct PreparedPlan {
  std::shared_ptr<const graph::Plan> plan;
  std::unique_ptr<ResourcePool> pool;
  std::vector<PreparedPass> passes;  // per step, of the variant in use; at first the one for large ages
  std::uint32_t passesPrepared = 0;  // how many were prepared for this plan; the others were kept
};

// A pass that differs from those of `before` (which may be null), or has other storage, is prepared. Empty after errors.
std::optional<PreparedPlan> preparePlan(Device& device, std::shared_ptr<const graph::Plan> plan,
                                        const PreparedPlan* before, ShaderFiles files,
                                        text::Diagnostics& diagnostics);

}  // namespace weft::runtime
