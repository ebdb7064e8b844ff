#include "engine/runtime/frame/prepared_plan.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "engine/runtime/prepare/pass_keeper.h"
#include "engine/runtime/prepare/prepare.h"
#include "engine/runtime/prepare/program_check.h"
#include "engine/runtime/prepare/program_request.h"

namespace weft::runtime {

namespace {

// A refusal by the device has no place: `place` gives it the place of what asked for it.
template <class Place>
void appendWithPlaces(const base::Diagnostics& said, const Place& place, base::Diagnostics& diagnostics) {
  for (base::Diagnostic each : said.items()) {
    if (!isKnown(each.place)) place(each);
    diagnostics.add(std::move(each));
  }
}

// Where the first resource of a storage is declared. `label` has the names of all resources that share it, "a | b". The place
// is unknown for a graph without places.
base::Place placeOfResource(const graph::FlatGraph& graph, const std::string& label) {
  const auto named = std::ranges::find(graph.resourceNames, label.substr(0, label.find(" | ")));
  const auto at = static_cast<std::size_t>(named - graph.resourceNames.begin());
  return at < graph.resourcePlaces.size() ? graph.resourcePlaces[at] : base::Place{};
}

// Prepares one plan, beside a running one if there is one.
class Preparation {
 public:
  Preparation(Device& device, PreparedPlan& made, const PreparedPlan* before, ShaderFiles files,
              base::Diagnostics& diagnostics)
      : device_(device), made_(made), before_(before), files_(files), diagnostics_(diagnostics) {
    if (before) findSame();
  }
  bool run() { return findVariants() && createPool() && preparePasses(); }

 private:
  void findSame();
  bool findVariants();
  std::shared_ptr<const gl::Variant> findVariant(std::size_t step, base::Diagnostics& problems);
  bool createPool();
  bool preparePasses();
  bool preparePassOf(std::size_t step, PrepareContext& context);
  std::uint32_t sameOf(std::size_t step) const { return before_ ? same_[step] : graph::kNone; }

  Device& device_;
  PreparedPlan& made_;
  const PreparedPlan* before_;
  const ShaderFiles files_;
  base::Diagnostics& diagnostics_;
  std::optional<PassKeeper> keeper_;
  std::vector<std::uint32_t> same_;  // per step: the step of the running plan that is the same, or kNone
  std::vector<std::shared_ptr<const gl::Variant>> variants_;  // per step
};

void Preparation::findSame() {
  keeper_.emplace(*made_.plan, *before_->plan);
  for (std::size_t step = 0; step < made_.plan->steps.size(); ++step) {
    const std::uint32_t old = keeper_->stepBefore(step);
    const bool same = old != graph::kNone && before_->passes[old].usable && keeper_->isSame(step, old);
    same_.push_back(same ? old : graph::kNone);
  }
}

bool Preparation::findVariants() {
  base::Diagnostics problems;
  for (std::size_t step = 0; step < made_.plan->steps.size(); ++step)
    variants_.push_back(findVariant(step, problems));
  diagnostics_.append(problems);
  return !problems.hasErrors();
}

std::shared_ptr<const gl::Variant> Preparation::findVariant(std::size_t step, base::Diagnostics& problems) {
  const graph::Plan& plan = *made_.plan;
  const std::uint32_t pass = plan.steps[step].pass;
  const graph::PassSpec& spec = plan.graph->specs[pass];
  if (files_ == ShaderFiles::keep)
    if (const std::uint32_t old = sameOf(step); old != graph::kNone) {
      const auto& variant = before_->passes[old].variant;
      if (variant) device_.programs.touch(variant);
      return variant;
    }
  const passes::PassType* type = device_.passTypes.find(spec.type);
  assert(type && "expansion accepts registered pass types only");
  const graph::PassType reflected = type->reflect();
  if (reflected.shader == graph::ShaderShape::none) return nullptr;
  auto variant = device_.programs.get(programRequestOf(*plan.graph, plan, pass, reflected), problems);
  if (!variant) return nullptr;
  const LinkedProgram linked{variant->program.reflection(), device_.context.device().limits};
  checkProgram(plan, pass, variant->stages, variant->defines, &linked, problems);
  return variant;
}

bool Preparation::createPool() {
  base::Diagnostics refused;
  made_.pool = ResourcePool::create(*made_.plan, before_ ? before_->pool.get() : nullptr, refused);
  const auto placeResource = [&](base::Diagnostic& d) {
    d.place = placeOfResource(*made_.plan->graph, d.resource);
  };
  appendWithPlaces(refused, placeResource, diagnostics_);
  return made_.pool != nullptr;
}

bool Preparation::preparePasses() {
  base::Diagnostics refused;
  PrepareContext context{*made_.plan,        device_.passTypes, nullptr, *made_.pool,
                         device_.geometries, device_.samplers,  refused};
  const std::size_t steps = made_.plan->steps.size();
  made_.passes.resize(steps);
  for (std::size_t step = 0; step < steps; ++step) {
    const std::uint32_t old = sameOf(step);
    if (old != graph::kNone && before_->passes[old].variant == variants_[step] &&
        keeper_->isInPlace(step, old, *made_.pool, *before_->pool))
      made_.passes[step] = keeper_->keep(step, old, before_->passes[old]);
    else if (!preparePassOf(step, context))
      return false;
  }
  return true;
}

bool Preparation::preparePassOf(std::size_t step, PrepareContext& context) {
  const graph::PassSpec& spec = made_.plan->graph->specs[made_.plan->steps[step].pass];
  ++made_.passesPrepared;
  context.variant = variants_[step];
  context.diagnostics.clear();
  made_.passes[step] = preparePass(context, step);
  const auto placePass = [&](base::Diagnostic& d) {
    d.place = spec.place;
    d.pass = spec.name;
  };
  appendWithPlaces(context.diagnostics, placePass, diagnostics_);
  PreparedPass& made = made_.passes[step];
  std::copy_n(device_.context.device().limits.computeGroups, 3, made.context.maxGroups);
  return made.usable;
}

}  // namespace

std::optional<PreparedPlan> preparePlan(Device& device, std::shared_ptr<const graph::Plan> plan,
                                        const PreparedPlan* before, ShaderFiles files,
                                        base::Diagnostics& diagnostics) {
  PreparedPlan made{.plan = std::move(plan), .pool = nullptr, .passes = {}};
  if (!Preparation(device, made, before, files, diagnostics).run()) return std::nullopt;
  return made;
}

}  // namespace weft::runtime
