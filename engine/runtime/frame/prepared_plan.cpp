// Declared in execution.h.
#include <algorithm>
#include <cassert>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "engine/runtime/frame/execution.h"
#include "engine/runtime/prepare/program_request.h"

namespace weft::runtime {

namespace {

// Whether they give the same program of the same files.
bool isSameProgram(const gl::ProgramRequest& a, const gl::ProgramRequest& b) {
  return a.stages == b.stages && a.defines == b.defines && a.outputs == b.outputs;
}

// A refusal by the device has no place: `place` gives it the place of what asked for it.
template <class Place>
void appendWithPlaces(const text::Diagnostics& said, const Place& place, text::Diagnostics& diagnostics) {
  for (text::Diagnostic each : said.items()) {
    if (!isKnown(each.place)) place(each);
    diagnostics.add(std::move(each));
  }
}

// Where the first resource of a storage is declared. `label` has the names of all resources that share it, "a | b". The place
// is unknown for a graph without places.
text::Place placeOfResource(const graph::FlatGraph& graph, const std::string& label) {
  const auto named = std::ranges::find(graph.resourceNames, label.substr(0, label.find(" | ")));
  const auto at = static_cast<std::size_t>(named - graph.resourceNames.begin());
  return at < graph.resourcePlaces.size() ? graph.resourcePlaces[at] : text::Place{};
}

}  // namespace

std::optional<PreparedPlan> preparePlan(Device& device, std::shared_ptr<const graph::Plan> plan,
                                        const PreparedPlan* before, ShaderFiles files,
                                        text::Diagnostics& diagnostics) {
  PreparedPlan made{.plan = std::move(plan), .pool = nullptr, .passes = {}, .requests = {}};
  const graph::FlatGraph& graph = *made.plan->graph;
  const std::size_t steps = made.plan->steps.size();
  std::unordered_map<std::string_view, std::size_t> stepBefore;  // by the name of its pass
  for (std::size_t step = 0; before && step < before->passes.size(); ++step)
    stepBefore.emplace(before->passes[step].context.spec->name, step);
  std::vector<std::shared_ptr<const gl::Variant>> variants(steps);
  text::Diagnostics problems;
  for (std::size_t step = 0; step < steps; ++step) {
    const std::uint32_t pass = made.plan->steps[step].pass;
    const passes::PassType* type = device.passTypes.find(graph.specs[pass].type);
    assert(type && "expansion accepts registered pass types only");
    const gl::ProgramRequest& request =
        made.requests.emplace_back(programRequestOf(graph, *made.plan, pass, type->reflect()));
    const auto old = stepBefore.find(graph.specs[pass].name);
    const bool known = old != stepBefore.end();
    std::shared_ptr<const gl::Variant>& variant = variants[step];
    if (known && files == ShaderFiles::keep && isSameProgram(request, before->requests[old->second]))
      variant = before->passes[old->second].variant;
    else if (!request.stages.empty())
      variant = device.programs.get(request, problems);
    if (!known || variant != before->passes[old->second].variant) ++made.programsChanged;
    if (!variant) continue;
    const LinkedProgram linked{variant->program.reflection(), device.context.device().limits};
    checkProgram(*made.plan, pass, variant->stages, variant->defines, &linked, problems);
  }
  diagnostics.append(problems);
  if (problems.hasErrors()) return std::nullopt;

  text::Diagnostics refused;
  made.pool = ResourcePool::create(*made.plan, before ? before->pool.get() : nullptr, refused);
  appendWithPlaces(
      refused, [&](text::Diagnostic& d) { d.place = placeOfResource(graph, d.resource); }, diagnostics);
  if (!made.pool) return std::nullopt;

  for (std::size_t step = 0; step < steps; ++step) {
    const graph::PassSpec& spec = graph.specs[made.plan->steps[step].pass];
    text::Diagnostics said;
    PrepareContext context{*made.plan,        device.passTypes, variants[step],          *made.pool,
                           device.geometries, device.samplers,  device.imports.tables(), said};
    std::optional<PreparedPass> pass = preparePass(context, step);
    appendWithPlaces(
        said,
        [&](text::Diagnostic& d) {
          d.place = spec.place;
          d.pass = spec.name;
        },
        diagnostics);
    if (!pass) return std::nullopt;
    std::copy_n(device.context.device().limits.computeGroups, 3, pass->context.maxGroups);
    made.passes.push_back(*std::move(pass));
  }
  return made;
}

}  // namespace weft::runtime
