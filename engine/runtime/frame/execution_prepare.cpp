// Preparing an execution: storage, programs, bindings, uniform layout; taking over from the execution before.
#include <algorithm>
#include <cassert>

#include "engine/runtime/cadence/lasting.h"
#include "engine/runtime/frame/execution.h"
#include "engine/runtime/prepare/program_check.h"
#include "engine/runtime/prepare/program_request.h"
#include "engine/runtime/storage/formats.h"

namespace weft::runtime {

Device::Device(gl::Context& c, std::vector<std::string> shaderRoots, std::string cacheFolder,
               std::vector<std::string> trial)
    : context(c),
      sources(std::move(shaderRoots)),
      programs(c.device(), sources,
               {.capacity = 32, .folder = std::move(cacheFolder), .trial = std::move(trial)}),
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

std::unique_ptr<Execution> Execution::create(Device& device, std::shared_ptr<const graph::Plan> plan,
                                             Execution* before, ShaderFiles files,
                                             base::Diagnostics& diagnostics) {
  std::unique_ptr<Execution> made(new Execution(device, std::move(plan)));
  if (!made->prepare(before, files, diagnostics)) return nullptr;
  return made;
}

bool Execution::prepare(Execution* before, ShaderFiles files, base::Diagnostics& diagnostics) {
  // Programs first: a shader that does not compile must cost the running execution nothing.
  const auto keeper = before ? std::make_unique<PassKeeper>(*plan_, *before->plan_) : nullptr;
  base::Diagnostics problems;
  std::vector<std::shared_ptr<const gl::Variant>> variants;
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
  if (problems.hasErrors()) return false;

  base::Diagnostics refused;
  pool_ = ResourcePool::create(*plan_, before ? before->pool_.get() : nullptr, refused);
  appendWithPlaces(
      refused, [&](base::Diagnostic& d) { d.place = placeOfResource(*plan_->graph, d.resource); },
      diagnostics);
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
  if (before) framebuffers_.takeOver(before->framebuffers_, pool_->textureNames());
  if (!preparePasses(before, variants, keeper.get(), diagnostics)) return false;
  for (const graph::ParameterSpec& parameter : plan_->graph->parameters) {
    parameterOf_.emplace(parameter.path, static_cast<std::uint32_t>(parameters_.size()));
    parameters_.push_back(parameter.value);
  }
  made_.resize(resources);
  for (std::size_t r = 0; r < resources; ++r) made_[r] = plan_->graph->resources[r].import != graph::kNone;
  for (const PreparedPass& pass : passes_)
    for (const std::uint32_t r : pass.written) made_[r] = 1;
  if (before) uniforms_ = std::move(before->uniforms_);
  layoutUniforms(diagnostics);
  if (!readBack_.prepare(*plan_, passes_, before ? &before->readBack_ : nullptr, diagnostics)) return false;
  if (before) carryOver(*before);
  return !diagnostics.hasErrors();
}

// Whether a pass is prepared for the variant that time settles on.
bool Execution::isSettled(std::size_t step) const {
  const PreparedPass& pass = passes_[step];
  return !pass.conditional || pass.conditions == settledConditionsOf(*pass.context.spec);
}

bool Execution::preparePasses(Execution* before,
                              const std::vector<std::shared_ptr<const gl::Variant>>& variants,
                              const PassKeeper* keeper, base::Diagnostics& diagnostics) {
  base::Diagnostics refused;
  PrepareContext context = prepareContext(refused);
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

PrepareContext Execution::prepareContext(base::Diagnostics& diagnostics) {
  return {.plan = *plan_,
          .types = device_.passTypes,
          .variant = nullptr,
          .pool = *pool_,
          .geometries = device_.geometries,
          .samplerOf =
              [](void* owner, const graph::Sampler& sampler, bool mipmapped, graph::Compare compare) {
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
  fillUniforms();
  listReaders();
  if (total == 0) return;
  // Padded so that comparing a 16-byte window of the last member stays inside.
  uniformBytes_.resize(total + 16);
  if (uniforms_ && uniforms_.bytes() >= uniformBytes_.size()) return;
  auto buffer = gl::Buffer::create(uniformBytes_.size(), GL_DYNAMIC_STORAGE_BIT, "uniforms", diagnostics);
  if (buffer) uniforms_ = std::move(*buffer);
}

// Storage moved with the pool; what a pass remembers of its last run moves by name, generations by storage.
void Execution::carryOver(Execution& before) {
  framesRun_ = before.framesRun_;
  std::unordered_map<std::string_view, std::size_t> resourceOf, stepOf, historyOf;
  const graph::FlatGraph &mine = *plan_->graph, &theirs = *before.plan_->graph;
  for (std::size_t r = 0; r < theirs.resourceNames.size(); ++r) resourceOf[theirs.resourceNames[r]] = r;
  for (std::size_t step = 0; step < before.plan_->steps.size(); ++step)
    stepOf[theirs.specs[before.plan_->steps[step].pass].name] = step;
  for (std::size_t h = 0; h < before.resetState_.size(); ++h)
    historyOf[theirs.resourceNames[theirs.histories[h].resource]] = h;
  for (std::size_t r = 0; r < generations_.size(); ++r) {
    const GpuResource& resource = (*pool_)[r];
    if (resource.fresh || resource.serial == 0) continue;
    const auto old = resourceOf.find(mine.resourceNames[r]);
    if (old != resourceOf.end() && (*before.pool_)[old->second].serial == resource.serial)
      generations_[r] = before.generations_[old->second];
  }
  for (std::size_t step = 0; step < passes_.size(); ++step)
    if (const auto old = stepOf.find(passes_[step].context.spec->name); old != stepOf.end())
      cadence_->memories()[step] = before.cadence_->memories()[old->second];
  std::vector<std::uint8_t> published(plan_->jobs.spread.begin(), plan_->jobs.spread.end());
  for (std::uint32_t r = 0; r < generations_.size(); ++r) {
    const GpuResource& resource = (*pool_)[r];
    if (resource.job != graph::kNone && plan_->firstStep[r] != graph::kNone && resource.publications == 0)
      published[resource.job] = 0;
  }
  for (std::uint32_t job = 0; job < published.size(); ++job)
    if (published[job]) cadence_->restorePublished(job);
  for (std::size_t h = 0; h < resetState_.size(); ++h)
    if (const auto old = historyOf.find(mine.resourceNames[mine.histories[h].resource]);
        old != historyOf.end())
      resetState_[h] = before.resetState_[old->second];
  adoptStandIns(before);
}

}  // namespace weft::runtime
