// Prepares a step of a plan: finds units and bindings by introspection of its program, makes views, and chooses samplers.
// Does not: compile programs (program_request.h), hold them against the pass (program_check.h), or lay out uniform bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "engine/passes/draw/geometry.h"
#include "engine/passes/pass_registry.h"
#include "engine/runtime/prepare/prepared_pass.h"
#include "engine/runtime/prepare/sampler_cache.h"

namespace weft::runtime {

// What preparePass() needs of the executor.
struct PrepareContext {
  const graph::Plan& plan;
  const passes::PassRegistry& types;
  std::shared_ptr<const gl::Variant> variant;  // of the pass to prepare; null for types without a shader
  ResourcePool& pool;
  passes::Geometries& geometries;
  SamplerCache& samplers;
  base::Diagnostics& diagnostics;
};

// Fills everything but the uniform offsets. Reports what does not fit; `usable` says whether the pass can run.
PreparedPass preparePass(PrepareContext& context, std::size_t step);

// How many instances a draw has whose number contains age(), see PassSpec::timedInstances.
std::uint32_t instancesAt(const graph::Expr& timed, const std::function<double(std::uint32_t)>& ageOf);

}  // namespace weft::runtime
