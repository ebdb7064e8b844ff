#include "engine/runtime/prepare/pass_keeper.h"

#include <algorithm>
#include <cassert>
#include <string_view>
#include <unordered_map>

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

bool sameShape(FlatResource a, const FlatResource& b) {
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
  return a.name == b.name && a.value.type == b.value.type && a.value.count == b.value.count;
}

bool sameSpec(const PassSpec& a, const PassSpec& b) {
  return a.type == b.type && a.shader == b.shader && a.vertexShader == b.vertexShader &&
         a.slotCount == b.slotCount && a.defines == b.defines &&
         std::ranges::equal(a.uniforms, b.uniforms, sameUniform) && a.state == b.state &&
         std::ranges::equal(a.threads, b.threads) && a.instances == b.instances && a.list == b.list &&
         a.geometry == b.geometry && a.geometryArguments == b.geometryArguments;
}

const graph::Value* clearOf(const FlatGraph& graph, std::uint32_t resource) {
  const auto found = std::ranges::find(graph.clears, resource, &graph::ClearSpec::resource);
  return found == graph.clears.end() ? nullptr : &found->value;
}

}  // namespace

PassKeeper::PassKeeper(const Plan& plan, const Plan& before) : plan_(plan), before_(before) {
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

bool PassKeeper::pairUp(std::size_t step, std::uint32_t old) {
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

bool PassKeeper::isSame(std::size_t step, std::uint32_t old) {
  assert(old == stepsBefore_[step]);
  const FlatGraph &mine = *plan_.graph, &theirs = *before_.graph;
  const graph::Step &stepNow = plan_.steps[step], &stepThen = before_.steps[old];
  const FlatPass &now = mine.passes[stepNow.pass], &then = theirs.passes[stepThen.pass];
  const PassSpec &spec = mine.specs[stepNow.pass], &specThen = theirs.specs[stepThen.pass];
  if (now.useCount != then.useCount || now.slices != then.slices ||
      stepNow.clearCount != stepThen.clearCount || !sameSpec(spec, specThen))
    return false;
  for (std::uint32_t i = 0; i < spec.slotCount; ++i)
    if (!sameSlot(mine, mine.slots[spec.firstSlot + i], theirs, theirs.slots[specThen.firstSlot + i]))
      return false;
  for (std::uint32_t i = 0; i < now.useCount; ++i) {
    const FlatUse &use = mine.uses[now.firstUse + i], &useThen = theirs.uses[then.firstUse + i];
    const FlatResource &resource = mine.resources[use.resource],
                       &resourceThen = theirs.resources[useThen.resource];
    if (!sameRange(use, useThen) || !sameShape(resource, resourceThen) ||
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

bool PassKeeper::isInPlace(std::size_t step, std::uint32_t old, const ResourcePool& pool,
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

PreparedPass PassKeeper::keep(std::size_t step, std::uint32_t old, PreparedPass prepared) {
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
  for (ImageBinding& binding : prepared.images) rename(binding);
  for (BufferBinding& binding : prepared.buffers) {
    if (binding.list >= 0) continue;  // names no resource
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

}  // namespace weft::runtime
