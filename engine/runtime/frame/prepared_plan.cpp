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

// The program of a step, checked against its pass; null for a pass type without a shader, and after errors.
std::shared_ptr<const gl::Variant> findVariant(Device& device, const graph::Plan& plan, std::size_t step,
                                               base::Diagnostics& problems) {
  const std::uint32_t pass = plan.steps[step].pass;
  const passes::PassType* type = device.passTypes.find(plan.graph->specs[pass].type);
  assert(type && "expansion accepts registered pass types only");
  const graph::PassType reflected = type->reflect();
  if (reflected.shader == graph::ShaderShape::none) return nullptr;
  auto variant = device.programs.get(programRequestOf(*plan.graph, plan, pass, reflected), problems);
  if (!variant) return nullptr;
  const LinkedProgram linked{variant->program.reflection(), device.context.device().limits};
  checkProgram(plan, pass, variant->stages, variant->defines, &linked, problems);
  return variant;
}

}  // namespace

std::optional<PreparedPlan> preparePlan(Device& device, std::shared_ptr<const graph::Plan> plan,
                                        const PreparedPlan* before, ShaderFiles files,
                                        base::Diagnostics& diagnostics) {
  PreparedPlan made{.plan = std::move(plan), .pool = nullptr, .passes = {}};
  const graph::FlatGraph& graph = *made.plan->graph;
  const std::size_t steps = made.plan->steps.size();
  std::optional<PassKeeper> keeper;
  if (before) keeper.emplace(*made.plan, *before->plan);
  std::vector<std::uint32_t> same(steps, graph::kNone);  // the step of the running plan that is the same
  std::vector<std::shared_ptr<const gl::Variant>> variants(steps);
  base::Diagnostics problems;
  for (std::size_t step = 0; step < steps; ++step) {
    const std::uint32_t old = keeper ? keeper->stepBefore(step) : graph::kNone;
    if (old != graph::kNone && before->passes[old].usable && keeper->isSame(step, old)) same[step] = old;
    if (files == ShaderFiles::read || same[step] == graph::kNone)
      variants[step] = findVariant(device, *made.plan, step, problems);
    else if ((variants[step] = before->passes[old].variant))
      device.programs.touch(variants[step]);
  }
  diagnostics.append(problems);
  if (problems.hasErrors()) return std::nullopt;

  base::Diagnostics refused;
  made.pool = ResourcePool::create(*made.plan, before ? before->pool.get() : nullptr, refused);
  appendWithPlaces(
      refused, [&](base::Diagnostic& d) { d.place = placeOfResource(graph, d.resource); }, diagnostics);
  if (!made.pool) return std::nullopt;

  made.passes.resize(steps);
  for (std::size_t step = 0; step < steps; ++step) {
    const std::uint32_t old = same[step];
    if (old != graph::kNone && before->passes[old].variant == variants[step] &&
        keeper->isInPlace(step, old, *made.pool, *before->pool)) {
      made.passes[step] = keeper->keep(step, old, before->passes[old]);
      continue;
    }
    const graph::PassSpec& spec = graph.specs[made.plan->steps[step].pass];
    ++made.passesPrepared;
    base::Diagnostics said;
    PrepareContext context{
        *made.plan, device.passTypes, variants[step], *made.pool, device.geometries, device.samplers, said};
    PreparedPass& pass = made.passes[step] = preparePass(context, step);
    appendWithPlaces(
        said,
        [&](base::Diagnostic& d) {
          d.place = spec.place;
          d.pass = spec.name;
        },
        diagnostics);
    std::copy_n(device.context.device().limits.computeGroups, 3, pass.context.maxGroups);
    if (!pass.usable) return std::nullopt;
  }
  return made;
}

}  // namespace weft::runtime
