// Preparing an execution: programs, storage, bindings, uniform layout; taking over from the execution before.
#include <algorithm>
#include <cassert>
#include <span>
#include <unordered_map>
#include <utility>

#include "engine/runtime/cadence/lasting.h"
#include "engine/runtime/frame/execution.h"
#include "engine/runtime/prepare/prepare.h"
#include "engine/runtime/prepare/program_check.h"
#include "engine/runtime/prepare/program_request.h"
#include "engine/runtime/storage/formats.h"

namespace weft::runtime {

namespace {

// What the device refuses has no place of its own: `place` gives it that of what asked for it.
template <class Place>
void appendWithPlaces(const base::Diagnostics& said, const Place& place, base::Diagnostics& diagnostics) {
  for (base::Diagnostic each : said.items()) {
    if (!isKnown(each.place)) place(each);
    diagnostics.add(std::move(each));
  }
}

// `label` of storage: the names of all that share it, "a | b". The declaration of the first; no place for a graph
// that has none.
base::Place placeOfResource(const graph::FlatGraph& graph, const std::string& label) {
  const auto named = std::ranges::find(graph.resourceNames, label.substr(0, label.find(" | ")));
  const auto at = static_cast<std::size_t>(named - graph.resourceNames.begin());
  return at < graph.resourcePlaces.size() ? graph.resourcePlaces[at] : base::Place{};
}

}  // namespace

std::unique_ptr<Execution> Execution::create(Device& device, std::shared_ptr<const graph::Plan> plan,
                                             Execution* before, ShaderFiles files,
                                             base::Diagnostics& diagnostics) {
  std::unique_ptr<Execution> made(new Execution(device, std::move(plan)));
  if (!made->prepare(before, files, diagnostics)) return nullptr;
  return made;
}

Execution::Execution(Device& device, std::shared_ptr<const graph::Plan> plan)
    : device_(device),
      plan_(std::move(plan)),
      arena_(static_cast<std::uint32_t>(std::max(16, device.context.device().limits.uniformOffsetAlignment))),
      values_(*plan_->graph) {}

bool Execution::prepare(Execution* before, ShaderFiles files, base::Diagnostics& diagnostics) {
  const auto keeper = before ? std::make_unique<PassKeeper>(*plan_, *before->plan_) : nullptr;
  Variants variants;
  // Programs first: a shader that does not compile must cost the running execution nothing.
  if (!findVariants(before, keeper.get(), files, variants, diagnostics)) return false;
  if (!createPool(before, diagnostics)) return false;
  if (before) runner_->framebuffers().takeOver(before->runner_->framebuffers(), pool_->textureNames());
  if (!preparePasses(before, keeper.get(), variants, diagnostics)) return false;
  publications_->listWritten();
  if (before) arena_.takeOver(before->arena_);
  layOutUniforms(diagnostics);
  if (!readBack_.prepare(*plan_, passes_, before ? &before->readBack_ : nullptr, diagnostics)) return false;
  if (before) takeOver(*before);
  followsPointer_ = readsPointer();
  return !diagnostics.hasErrors();
}

bool Execution::readsPointer() const {
  const graph::FlatGraph& graph = *plan_->graph;
  const auto follows = [&](const graph::FlatUse& use) {
    const std::uint32_t import = graph.resources[use.resource].import;
    return import != graph::kNone && device_.imports.followsPointer(graph.imports[import]);
  };
  return std::ranges::any_of(plan_->steps, [&](const graph::Step& step) {
    const graph::FlatPass& pass = graph.passes[step.pass];
    return std::ranges::any_of(std::span(graph.uses).subspan(pass.firstUse, pass.useCount), follows);
  });
}

bool Execution::findVariants(const Execution* before, const PassKeeper* keeper, ShaderFiles files,
                             Variants& variants, base::Diagnostics& diagnostics) {
  base::Diagnostics problems;
  for (std::size_t step = 0; step < plan_->steps.size(); ++step) {
    const std::uint32_t pass = plan_->steps[step].pass;
    const graph::PassSpec& spec = plan_->graph->specs[pass];
    const std::uint32_t old = keeper && files == ShaderFiles::keep ? keeper->stepBefore(step) : graph::kNone;
    variants.emplace_back();
    if (old != graph::kNone && before->passes_[old].usable && before->isSettled(old) &&
        keeper->isSame(step, old)) {
      variants.back() = before->passes_[old].variant;
      if (variants.back()) device_.programs.touch(variants.back());
      continue;
    }
    const passes::PassType* type = device_.passTypes.find(spec.type);
    assert(type && "expansion accepts registered pass types only");
    const graph::PassType reflected = type->reflect();
    if (reflected.shader == graph::ShaderShape::none) continue;
    variants.back() = device_.programs.get(
        programRequestOf(*plan_->graph, *plan_, pass, reflected, settledConditionsOf(spec)), problems);
    if (variants.back())
      checkProgram(*plan_, pass, *variants.back(), device_.context.device().limits, problems);
  }
  diagnostics.append(problems);
  return !problems.hasErrors();
}

bool Execution::createPool(Execution* before, base::Diagnostics& diagnostics) {
  base::Diagnostics refused;
  pool_ = ResourcePool::create(*plan_, before ? before->pool_.get() : nullptr, refused);
  const auto placeResource = [&](base::Diagnostic& d) {
    d.place = placeOfResource(*plan_->graph, d.resource);
  };
  appendWithPlaces(refused, placeResource, diagnostics);
  if (!pool_) return false;
  const std::size_t steps = plan_->steps.size();
  hashes_.assign(steps, 0);
  ran_.assign(steps, 0);
  lasting_ = findLastingSteps(*plan_);
  cadence_ = std::make_unique<FrameCadence>(*plan_);
  publications_.emplace(*plan_, *pool_, device_.imports, *cadence_, passes_);
  variants_.emplace(*plan_, device_, *pool_, passes_);
  runner_.emplace(*plan_, device_, *pool_, arena_);
  return true;
}

// Whether a pass is prepared for the variant that time settles on.
bool Execution::isSettled(std::size_t step) const {
  const PreparedPass& pass = passes_[step];
  return !pass.conditional || pass.conditions == settledConditionsOf(*pass.context.spec);
}

bool Execution::preparePasses(Execution* before, const PassKeeper* keeper, const Variants& variants,
                              base::Diagnostics& diagnostics) {
  base::Diagnostics refused;
  PrepareContext context{*plan_, device_.passTypes,  nullptr,          0,
                         *pool_, device_.geometries, device_.samplers, refused};
  passes_.reserve(plan_->steps.size());
  for (std::size_t step = 0; step < plan_->steps.size(); ++step) {
    const std::uint32_t old = keeper ? keeper->stepBefore(step) : graph::kNone;
    if (old != graph::kNone && before->passes_[old].usable && before->isSettled(old) &&
        before->passes_[old].variant == variants[step] && keeper->isSame(step, old) &&
        keeper->isInPlace(step, old, *pool_, *before->pool_)) {
      passes_.push_back(keeper->take(step, old, std::move(before->passes_[old])));
      continue;
    }
    ++passesPrepared_;
    const graph::PassSpec& spec = plan_->graph->specs[plan_->steps[step].pass];
    context.variant = variants[step];
    context.conditions = settledConditionsOf(spec);
    refused.clear();
    passes_.push_back(preparePass(context, step));
    const auto placePass = [&](base::Diagnostic& d) {
      d.place = spec.place;
      d.pass = spec.name;
    };
    appendWithPlaces(refused, placePass, diagnostics);
    std::copy_n(device_.context.device().limits.computeGroups, 3, passes_.back().context.maxGroups);
    if (!passes_.back().usable) return false;
  }
  return true;
}

// Storage moved with the pool. What a pass remembers of its last run moves by name.
void Execution::takeOver(Execution& before) {
  std::unordered_map<std::string_view, std::size_t> stepOf;
  for (std::size_t step = 0; step < before.plan_->steps.size(); ++step)
    stepOf[before.plan_->graph->specs[before.plan_->steps[step].pass].name] = step;
  for (std::size_t step = 0; step < passes_.size(); ++step)
    if (const auto old = stepOf.find(passes_[step].context.spec->name); old != stepOf.end())
      cadence_->memories()[step] = before.cadence_->memories()[old->second];
  publications_->takeOver(*before.publications_);
}

}  // namespace weft::runtime
