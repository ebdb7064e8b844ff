// Declared in execution.h.
#include <algorithm>
#include <cassert>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "engine/runtime/frame/execution.h"
#include "engine/runtime/prepare/program_request.h"

namespace weft::runtime {

using graph::FlatGraph;
using graph::FlatPass;
using graph::FlatResource;
using graph::FlatUse;
using graph::kNone;
using graph::PassSpec;
using graph::Plan;
using graph::SlotSpec;

namespace {

bool sameRange(FlatUse a, const FlatUse& b) {
  a.resource = b.resource;
  a.keep = b.keep;
  return a == b;
}

bool isShapedLike(FlatResource a, const FlatResource& b) {
  a.hasClear = b.hasClear;
  a.import = b.import;
  return a == b;
}

bool sameImport(const FlatGraph& a, std::uint32_t x, const FlatGraph& b, std::uint32_t y) {
  if (x == kNone || y == kNone) return x == y;
  return a.imports[x].request == b.imports[y].request && a.imports[x].kind == b.imports[y].kind;
}

bool sameSlot(const FlatGraph& mine, const SlotSpec& a, const FlatGraph& theirs, const SlotSpec& b) {
  return a.name == b.name && a.access == b.access && a.kind == b.kind && a.sampler == b.sampler &&
         mine.borderOf(a) == theirs.borderOf(b) && a.useCount == b.useCount && a.array == b.array &&
         a.optional == b.optional && (a.firstValue == kNone) == (b.firstValue == kNone);
}

bool sameUniform(const graph::UniformSpec& a, const graph::UniformSpec& b) {
  return a.name == b.name && a.element == b.element && a.elements == b.elements &&
         a.value.type == b.value.type && a.value.count == b.value.count;
}

bool sameSpec(const PassSpec& a, const PassSpec& b) {
  return a.type == b.type && a.shader == b.shader && a.vertexShader == b.vertexShader &&
         a.slotCount == b.slotCount && a.defines == b.defines &&
         std::ranges::equal(a.uniforms, b.uniforms, sameUniform) && a.state == b.state &&
         std::ranges::equal(a.threads, b.threads) && a.instances == b.instances && a.list == b.list &&
         a.geometry == b.geometry && a.geometryArguments == b.geometryArguments && a.draws == b.draws &&
         a.raster == b.raster && a.rasterSamples == b.rasterSamples;
}

const graph::Value* clearOf(const FlatGraph& graph, std::uint32_t resource) {
  const auto found = std::ranges::find(graph.clears, resource, &graph::ClearSpec::resource);
  return found == graph.clears.end() ? nullptr : &found->value;
}

// Finds the passes of a new plan that are equal to passes of the running plan, so that what was prepared for those (program,
// bindings, views, attachments) can be kept. Passes are matched by their instance names, resources by the slots that use them.
// Compares descriptions and the identity of storage only: shader files and values of uniforms, which are written anew, do not count.
class PassKeeper {
 public:
  PassKeeper(const Plan& plan, const Plan& before) : plan_(plan), before_(before) {
    std::unordered_map<std::string_view, std::uint32_t> stepOf;  // of the running plan
    stepOf.reserve(before.steps.size());
    for (std::uint32_t step = 0; step < before.steps.size(); ++step)
      stepOf.emplace(before.graph->specs[before.steps[step].pass].name, step);
    stepsBefore_.reserve(plan.steps.size());
    for (const graph::Step& step : plan.steps) {
      const auto found = stepOf.find(plan.graph->specs[step.pass].name);
      stepsBefore_.push_back(found == stepOf.end() ? kNone : found->second);
    }
  }

  // The step of the running plan with the name of `step`, or kNone.
  std::uint32_t stepBefore(std::size_t step) const { return stepsBefore_[step]; }

  // Whether everything that the program is made of, and is checked against, is the same. `old`: stepBefore(step).
  bool isSame(std::size_t step, std::uint32_t old) {
    assert(old == stepsBefore_[step]);
    const FlatGraph &mine = *plan_.graph, &theirs = *before_.graph;
    const graph::Step &stepNow = plan_.steps[step], &stepThen = before_.steps[old];
    const FlatPass &now = mine.passes[stepNow.pass], &then = theirs.passes[stepThen.pass];
    const PassSpec &spec = mine.specs[stepNow.pass], &specThen = theirs.specs[stepThen.pass];
    if (now.useCount != then.useCount || now.slices != then.slices ||
        stepNow.clearCount != stepThen.clearCount || !sameSpec(spec, specThen) ||
        !sameImport(mine, spec.listImport, theirs, specThen.listImport))
      return false;
    for (std::uint32_t i = 0; i < spec.slotCount; ++i)
      if (!sameSlot(mine, mine.slots[spec.firstSlot + i], theirs, theirs.slots[specThen.firstSlot + i]))
        return false;
    for (std::uint32_t i = 0; i < now.useCount; ++i) {
      const FlatUse &use = mine.uses[now.firstUse + i], &useThen = theirs.uses[then.firstUse + i];
      const FlatResource &resource = mine.resources[use.resource],
                         &resourceThen = theirs.resources[useThen.resource];
      if (!sameRange(use, useThen) || !isShapedLike(resource, resourceThen) ||
          plan_.attached[now.firstUse + i] != before_.attached[then.firstUse + i] ||
          !sameImport(mine, resource.import, theirs, resourceThen.import))
        return false;
    }
    if (!pairUp(step, old)) return false;
    for (std::uint32_t i = 0; i < stepNow.clearCount; ++i) {
      const FlatUse &use = plan_.clears[stepNow.firstClear + i].use,
                    &useThen = before_.clears[stepThen.firstClear + i].use;
      const auto pair = std::ranges::find(pairs_, useThen.resource, &Pairs::value_type::first);
      if (pair == pairs_.end() || pair->second != use.resource || !sameRange(use, useThen)) return false;
      const graph::Value *value = clearOf(mine, use.resource), *valueThen = clearOf(theirs, useThen.resource);
      if (!value || !valueThen || !(*value == *valueThen)) return false;
    }
    return true;
  }

  // Whether the two steps also use the same storage. isSame() must hold.
  bool isInPlace(std::size_t step, std::uint32_t old, const ResourcePool& pool,
                 const ResourcePool& poolBefore) const {
    const FlatPass& now = plan_.graph->passes[plan_.steps[step].pass];
    const FlatPass& then = before_.graph->passes[before_.steps[old].pass];
    for (std::uint32_t i = 0; i < now.useCount; ++i) {
      const GpuResource& mine = pool[plan_.graph->uses[now.firstUse + i].resource];
      const GpuResource& theirs = poolBefore[before_.graph->uses[then.firstUse + i].resource];
      if (mine.serial != theirs.serial || mine.copies != theirs.copies) return false;
    }
    return true;
  }

  // What was prepared for `old`, for `step`. isSame() and isInPlace() must hold.
  PreparedPass keep(std::size_t step, std::uint32_t old, PreparedPass prepared) {
    [[maybe_unused]] const bool paired = pairUp(step, old);
    assert(paired && "isSame() held");
    const auto nowOf = [&](std::uint32_t resource) {
      const auto pair = std::ranges::find(pairs_, resource, &Pairs::value_type::first);
      return pair == pairs_.end() ? resource : pair->second;
    };
    const FlatGraph& graph = *plan_.graph;
    const std::uint32_t pass = plan_.steps[step].pass;
    const auto rename = [&](auto& binding) {
      binding.resource = nowOf(binding.resource);
      binding.firstOf.resource = nowOf(binding.firstOf.resource);
    };
    for (TextureBinding& binding : prepared.textures) rename(binding);
    for (BufferBinding& binding : prepared.buffers) {
      if (binding.drawn) continue;  // names no resource
      rename(binding);
      if (binding.import != kNone) binding.import = graph.resources[binding.resource].import;
    }
    for (AttachmentBinding& binding : prepared.attachments)
      binding.resource = binding.use.resource = nowOf(binding.resource);
    for (FixedBinding& binding : prepared.fixed) rename(binding);
    for (ClearCommand& clear : prepared.clears) clear.use.resource = nowOf(clear.use.resource);
    for (std::uint32_t& resource : prepared.written) resource = nowOf(resource);
    for (std::uint32_t& resource : prepared.read) resource = nowOf(resource);
    prepared.context.spec = &graph.specs[pass];
    prepared.group = plan_.groups.groupOf(pass);
    return prepared;
  }

 private:
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  // resources: before, now

  // Fills pairs_. False when a resource of the running plan would be two in the new plan, or two would be one.
  bool pairUp(std::size_t step, std::uint32_t old) {
    pairs_.clear();
    const FlatGraph &mine = *plan_.graph, &theirs = *before_.graph;
    const FlatPass &now = mine.passes[plan_.steps[step].pass], &then = theirs.passes[before_.steps[old].pass];
    for (std::uint32_t i = 0; i < now.useCount; ++i) {
      const std::uint32_t from = theirs.uses[then.firstUse + i].resource,
                          to = mine.uses[now.firstUse + i].resource;
      const auto known =
          std::ranges::find_if(pairs_, [&](const auto& p) { return p.first == from || p.second == to; });
      if (known == pairs_.end())
        pairs_.emplace_back(from, to);
      else if (known->first != from || known->second != to)
        return false;
    }
    return true;
  }

  const Plan &plan_, &before_;
  std::vector<std::uint32_t> stepsBefore_;  // by step; kNone: there is none
  Pairs pairs_;                             // of the step that pairUp() was last called for
};

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

// The program of a step, checked against its pass; null for a pass type without a shader, and after errors.
std::shared_ptr<const gl::Variant> findVariant(Device& device, const graph::Plan& plan, std::size_t step,
                                               text::Diagnostics& problems) {
  const std::uint32_t pass = plan.steps[step].pass;
  const passes::PassType* type = device.passTypes.find(plan.graph->specs[pass].type);
  assert(type && "expansion accepts registered pass types only");
  const graph::PassType reflected = type->reflect();
  if (reflected.shader == graph::ShaderShape::none) return nullptr;
  auto variant = device.programs.get(programRequestOf(*plan.graph, plan, pass, reflected), problems);
  if (!variant) return nullptr;
  const LinkedProgram linked{variant->program.reflection(), device.context.device()};
  checkProgram(plan, pass, variant->stages, variant->defines, &linked, problems);
  return variant;
}

}  // namespace

std::optional<PreparedPlan> preparePlan(Device& device, std::shared_ptr<const graph::Plan> plan,
                                        const PreparedPlan* before, ShaderFiles files,
                                        text::Diagnostics& diagnostics) {
  PreparedPlan made{.plan = std::move(plan), .pool = nullptr, .passes = {}};
  const graph::FlatGraph& graph = *made.plan->graph;
  const std::size_t steps = made.plan->steps.size();
  std::optional<PassKeeper> keeper;
  if (before) keeper.emplace(*made.plan, *before->plan);
  std::vector<std::uint32_t> same(steps, graph::kNone);  // the step of the running plan that is the same
  std::vector<std::shared_ptr<const gl::Variant>> variants(steps);
  text::Diagnostics problems;
  for (std::size_t step = 0; step < steps; ++step) {
    const std::uint32_t old = keeper ? keeper->stepBefore(step) : graph::kNone;
    if (old != graph::kNone && keeper->isSame(step, old)) same[step] = old;
    if (files == ShaderFiles::read || same[step] == graph::kNone)
      variants[step] = findVariant(device, *made.plan, step, problems);
    else
      variants[step] = before->passes[old].variant;
  }
  diagnostics.append(problems);
  if (problems.hasErrors()) return std::nullopt;

  text::Diagnostics refused;
  made.pool = ResourcePool::create(*made.plan, before ? before->pool.get() : nullptr, refused);
  appendWithPlaces(
      refused, [&](text::Diagnostic& d) { d.place = placeOfResource(graph, d.resource); }, diagnostics);
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
    std::copy_n(device.context.device().computeGroups, 3, pass->context.maxGroups);
    made.passes[step] = *std::move(pass);
  }
  return made;
}

}  // namespace weft::runtime
