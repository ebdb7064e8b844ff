#include "engine/runtime/frame/variant_choice.h"

#include <algorithm>
#include <utility>

#include "engine/runtime/prepare/prepare.h"
#include "engine/runtime/prepare/program_check.h"
#include "engine/runtime/prepare/program_request.h"

namespace weft::runtime {

bool VariantChoice::choose(const std::function<double(std::uint32_t)>& ageOf, bool alwaysOnly,
                           base::Diagnostics& diagnostics) {
  bool isNew = false;
  for (std::size_t step = 0; step < passes_.size(); ++step) {
    const PreparedPass& pass = passes_[step];
    const bool always = plan_.graph->passes[plan_.steps[step].pass].cadence == graph::Cadence::always;
    if (!pass.conditional || (alwaysOnly && !always)) continue;
    const std::uint32_t conditions = conditionsOf(*pass.context.spec, ageOf);
    if (conditions != pass.conditions) isNew |= take(step, conditions, diagnostics);
  }
  return isNew;
}

bool VariantChoice::take(std::size_t step, std::uint32_t conditions, base::Diagnostics& diagnostics) {
  for (Parked& parked : parked_) {
    if (parked.step != step || parked.pass.conditions != conditions) continue;
    if (parked.pass.usable) std::swap(passes_[step], parked.pass);
    return false;
  }
  const std::uint32_t pass = plan_.steps[step].pass;
  const graph::PassType type = passes_[step].type->reflect();
  const gl::Limits& limits = device_.context.device().limits;
  PrepareContext context{plan_, device_.passTypes,  nullptr,          conditions,
                         pool_, device_.geometries, device_.samplers, diagnostics};
  const bool shaded = type.shader != graph::ShaderShape::none;
  if (shaded)
    context.variant =
        device_.programs.get(programRequestOf(*plan_.graph, plan_, pass, type, conditions), diagnostics);
  PreparedPass made;
  if (!shaded ||
      (context.variant && checkProgram(plan_, pass, *context.variant, limits, device_.roles, diagnostics)))
    made = preparePass(context, step);
  made.conditions = conditions;
  std::copy_n(limits.computeGroups, 3, made.context.maxGroups);
  parked_.push_back({step, std::move(made)});
  if (!parked_.back().pass.usable) return false;
  std::swap(passes_[step], parked_.back().pass);
  return true;
}

std::span<PreparedPass* const> VariantChoice::all() {
  all_.clear();
  for (PreparedPass& pass : passes_) all_.push_back(&pass);
  for (Parked& parked : parked_) all_.push_back(&parked.pass);
  return all_;
}

}  // namespace weft::runtime
