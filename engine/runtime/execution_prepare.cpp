// Preparing an execution: storage, programs, bindings, uniform layout; taking over from the execution before.
#include <algorithm>
#include <cassert>

#include "engine/runtime/execution.h"
#include "engine/runtime/formats.h"
#include "engine/runtime/lasting.h"

namespace weft::runtime {

Device::Device(gl::Context& c, std::vector<std::string> shaderRoots, std::string cacheFolder,
               std::vector<std::string> trial)
    : context(c),
      sources(std::move(shaderRoots)),
      programs(c.device(), sources, {.capacity = 32, .folder = std::move(cacheFolder), .trial = std::move(trial)}),
      timers(c.device()) {}

GLuint Device::sampler(const graph::Sampler& sampler, bool mipmapped, graph::Compare compare) {
  gl::SamplerDesc desc;
  const bool linear = sampler.linear || sampler.compare;
  desc.magFilter = linear ? GL_LINEAR : GL_NEAREST;
  desc.minFilter = !mipmapped ? desc.magFilter : linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_NEAREST;
  desc.wrap = sampler.wrap ? GL_REPEAT : GL_CLAMP_TO_EDGE;
  if (sampler.compare) desc.compare = compare == graph::Compare::always ? GL_LEQUAL : glCompareOf(compare);
  for (const CachedSampler& each : samplers_)
    if (each.desc == desc) return each.object.id();
  samplers_.push_back({desc, gl::SamplerObject::create(desc, linear ? "linear" : "nearest")});
  return samplers_.back().object.id();
}

namespace {

// What the device refuses has no place of its own: `place` gives it that of what asked for it.
template <class Place>
void appendWithPlaces(const base::Diagnostics& said, const Place& place, base::Diagnostics& diagnostics) {
  for (base::Diagnostic each : said.items()) {
    if (!each.place.file) place(each);
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

std::unique_ptr<Execution> Execution::create(Device& device, std::shared_ptr<const graph::Plan> plan, Execution* before,
                                             base::Diagnostics& diagnostics) {
  std::unique_ptr<Execution> made(new Execution(device, std::move(plan)));
  if (!made->prepare(before, diagnostics)) return nullptr;
  return made;
}

bool Execution::prepare(Execution* before, base::Diagnostics& diagnostics) {
  // Programs first: a shader that does not compile must cost the running execution nothing.
  base::Diagnostics problems;
  std::vector<std::shared_ptr<const gl::Variant>> variants;
  for (const graph::Step& step : plan_->steps) {
    const passes::PassType* type = device_.passTypes.find(plan_->graph->specs[step.pass].type);
    assert(type && "expansion accepts registered pass types only");
    const graph::PassType reflected = type->reflect();
    variants.emplace_back();
    if (reflected.shader == graph::ShaderShape::none) continue;
    const std::uint32_t settled = settledConditionsOf(plan_->graph->specs[step.pass]);
    variants.back() =
        device_.programs.get(programRequestOf(*plan_->graph, *plan_, step.pass, reflected, settled), problems);
    if (variants.back()) checkProgram(*plan_, step.pass, *variants.back(), device_.context.device().limits, problems);
  }
  diagnostics.append(problems);
  if (problems.hasErrors()) return false;

  base::Diagnostics refused;
  pool_ = ResourcePool::create(*plan_, before ? before->pool_.get() : nullptr, refused);
  appendWithPlaces(refused, [&](base::Diagnostic& d) { d.place = placeOfResource(*plan_->graph, d.resource); }, diagnostics);
  if (!pool_) return false;
  const std::size_t resources = plan_->graph->resources.size();
  nextGeneration_ = before ? before->nextGeneration_ : 1;
  generations_.resize(resources);
  for (std::uint64_t& generation : generations_) generation = nextGeneration_++;
  rotated_.assign(resources, 0);
  cadence_ = std::make_unique<FrameCadence>(*plan_);
  own_.assign(plan_->steps.size(), 0);
  ran_.assign(plan_->steps.size(), 0);
  lasting_ = findLastingSteps(*plan_);
  publishing_.assign(resources, 0);
  resetState_.assign(plan_->graph->histories.size(), 0);
  findMakers();
  PrepareContext context = prepareContext(refused);
  for (std::size_t step = 0; step < plan_->steps.size(); ++step) {
    context.variant = variants[step];
    context.conditions = settledConditionsOf(plan_->graph->specs[plan_->steps[step].pass]);
    refused.clear();
    passes_.push_back(preparePass(context, step));
    const graph::PassSpec& spec = plan_->graph->specs[plan_->steps[step].pass];
    const auto placePass = [&](base::Diagnostic& d) {
      d.place = spec.place;
      d.pass = spec.name;
    };
    appendWithPlaces(refused, placePass, diagnostics);
    std::copy_n(device_.context.device().limits.computeGroups, 3, passes_.back().context.maxGroups);
    if (!passes_.back().usable) return false;
  }
  made_.resize(resources);
  for (std::size_t r = 0; r < resources; ++r) made_[r] = plan_->graph->resources[r].import != graph::kNone;
  for (const PreparedPass& pass : passes_)
    for (const std::uint32_t r : pass.written) made_[r] = 1;
  layoutUniforms(diagnostics);
  if (!readBack_.prepare(*plan_, passes_, before ? &before->readBack_ : nullptr, diagnostics)) return false;
  if (before) carryOver(*before);
  return !diagnostics.hasErrors();
}

PrepareContext Execution::prepareContext(base::Diagnostics& diagnostics) {
  return {.plan = *plan_,
          .types = device_.passTypes,
          .variant = nullptr,
          .pool = *pool_,
          .geometries = device_.geometries,
          .samplerOf = [](void* owner, const graph::Sampler& sampler, bool mipmapped,
                          graph::Compare compare) {
            return static_cast<Device*>(owner)->sampler(sampler, mipmapped, compare);
          },
          .samplerOwner = &device_,
          .diagnostics = diagnostics};
}

void Execution::layoutUniforms(base::Diagnostics& diagnostics) {
  const auto alignment =
      static_cast<std::uint32_t>(std::max(16, device_.context.device().limits.uniformOffsetAlignment));
  std::uint32_t total = 0;
  const auto place = [&](const gl::Block* block) {
    const std::uint32_t at = total;
    if (block) total += (block->bytes + alignment - 1) / alignment * alignment;
    return at;
  };
  std::vector<PreparedPass*> all;
  for (PreparedPass& pass : passes_) all.push_back(&pass);
  for (Parked& parked : parked_) all.push_back(&parked.pass);
  for (PreparedPass* pass : all) {
    pass->parametersOffset = place(pass->parametersBlock);
    pass->viewOffset = place(pass->viewBlock);
    pass->sliceOffset = place(pass->sliceBlock);
  }
  uniformBytes_.assign(total, std::byte{0});
  uniformsDirty_ = true;
  for (PreparedPass* each : all) {
    PreparedPass& pass = *each;
    pass.dynamics.clear();
    if (!pass.parametersBlock) continue;
    for (const graph::UniformSpec& uniform : pass.context.spec->uniforms) {
      if (uniform.define) continue;
      const gl::BlockMember* member = pass.parametersBlock->find(uniform.name);
      if (!member) continue;
      if (uniform.dynamic.present()) pass.dynamics.push_back({*member, uniform.dynamic});
      else writeValue(uniformBytes_.data() + pass.parametersOffset, *member, uniform.value);
    }
  }
  if (total == 0) return;
  // Padded so that comparing a 16-byte window of the last member stays inside.
  uniformBytes_.resize(total + 16);
  auto buffer = gl::Buffer::create(uniformBytes_.size(), GL_DYNAMIC_STORAGE_BIT, "uniforms", diagnostics);
  if (buffer) uniforms_ = std::move(*buffer);
}

// Storage moved with the pool; what a pass remembers of its last run moves by name, generations by storage.
void Execution::carryOver(Execution& before) {
  framesRun_ = before.framesRun_;
  for (std::size_t r = 0; r < generations_.size(); ++r) {
    const GpuResource& mine = (*pool_)[r];
    if (mine.fresh || mine.serial == 0) continue;
    const auto& names = before.plan_->graph->resourceNames;
    for (std::size_t o = 0; o < names.size(); ++o)
      if (names[o] == plan_->graph->resourceNames[r] && (*before.pool_)[o].serial == mine.serial)
        generations_[r] = before.generations_[o];
  }
  for (std::size_t step = 0; step < passes_.size(); ++step) {
    const std::string& name = passes_[step].context.spec->name;
    for (std::size_t old = 0; old < before.passes_.size(); ++old)
      if (before.plan_->graph->specs[before.plan_->steps[old].pass].name == name)
        cadence_->memories()[step] = before.cadence_->memories()[old];
  }
  for (std::uint32_t job = 0; job < plan_->jobs.spread.size(); ++job) {
    bool published = plan_->jobs.spread[job] != 0;
    for (std::uint32_t r = 0; r < generations_.size(); ++r)
      if ((*pool_)[r].job == job && plan_->firstStep[r] != graph::kNone) published &= (*pool_)[r].publications > 0;
    if (published) cadence_->restorePublished(job);
  }
  for (std::size_t h = 0; h < resetState_.size(); ++h)
    for (std::size_t o = 0; o < before.resetState_.size(); ++o) {
      const auto& mine = plan_->graph->resourceNames[plan_->graph->histories[h].resource];
      const auto& theirs = before.plan_->graph->resourceNames[before.plan_->graph->histories[o].resource];
      if (mine == theirs) resetState_[h] = before.resetState_[o];
    }
  adoptStandIns(before);
}

}  // namespace weft::runtime
