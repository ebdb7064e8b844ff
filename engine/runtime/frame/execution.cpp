// The frame loop: what changed, what runs. One step of it stands in execution_step.cpp, preparing in
// execution_prepare.cpp.
#include "engine/runtime/frame/execution.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "engine/base/hash.h"
#include "engine/passes/compute/work_groups.h"
#include "engine/runtime/storage/formats.h"

namespace weft::runtime {

using graph::kNone;

FrameReport Execution::frame(const World& world, const FrameInput& input, base::Diagnostics& diagnostics) {
  world_ = &world;
  input_ = input;
  states_.forget();
  FrameReport report;
  device_.timers.beginFrame(static_cast<std::uint32_t>(passes_.size()));
  std::fill(ran_.begin(), ran_.end(), std::uint8_t{0});
  device_.imports.beginFrame(world, input);
  readBack_.collect();
  std::fill(publishing_.begin(), publishing_.end(), std::uint8_t{0});
  choosePasses(false, diagnostics);
  holdFading();
  bool turned = publishFinished();
  refreshImports(diagnostics);
  turned |= resetHistories(diagnostics);
  if (turned) choosePasses(false, diagnostics);
  refreshUniforms(false);
  refreshOwnHashes();
  if (input.headless) finishSlices(report, diagnostics);
  cadence_->decide(own_, generations_);
  followWhole(diagnostics);
  runDecided(report, diagnostics);
  releaseImports();
  device_.timers.endFrame();
  if (plan_->finalBarriers) {
    glMemoryBarrier(glBarriersOf(plan_->finalBarriers));
    ++report.barriers;
  }
  if (report.whole) readBack_.copy(*plan_, *pool_, framebuffers_, input.frame, diagnostics);
  report.passesRun = static_cast<std::uint32_t>(std::ranges::count(ran_, std::uint8_t{1}));
  for (std::size_t step = 0; step < ran_.size(); ++step)
    report.slowRun +=
        ran_[step] && plan_->graph->passes[plan_->steps[step].pass].cadence != graph::Cadence::always;
  report.passesSkipped = static_cast<std::uint32_t>(passes_.size()) - report.passesRun;
  ++framesRun_;
  return report;
}

// Every job that has something to do does all of it before the frame. A job may wait for what another publishes, so at
// most as many rounds as there are jobs.
void Execution::finishSlices(FrameReport& report, base::Diagnostics& diagnostics) {
  bool any = false;
  for (std::size_t round = 0; round < plan_->jobs.spread.size() && cadence_->decideAhead(own_, generations_);
       ++round) {
    runDecided(report, diagnostics);
    publishFinished();
    viewImports(diagnostics);
    states_.forget();  // an upload may have changed it
    any = true;
  }
  if (!any) return;
  choosePasses(false, diagnostics);  // ages
  refreshUniforms(false);
}

// Barriers are issued of skipped steps too, see plan.h.
void Execution::runDecided(FrameReport& report, base::Diagnostics& diagnostics) {
  generationsBefore_ = generations_;
  refreshSlices();
  if (uniformsDirty_ && !uniformBytes_.empty()) {
    gl::uploadBuffer(uniforms_.id(), 0, uniformBytes_);
    uniformsDirty_ = false;
  }
  // Before any step: a pass that reads x@-1 may stand before the one that writes x.
  std::fill(rotated_.begin(), rotated_.end(), std::uint8_t{0});
  for (std::size_t step = 0; step < passes_.size(); ++step)
    if (cadence_->runs(step)) rotateWritten(passes_[step]);
  for (std::size_t step = 0; step < passes_.size(); ++step) {
    const graph::Step& planned = plan_->steps[step];
    if (planned.barriers) {
      glMemoryBarrier(glBarriersOf(planned.barriers));
      ++report.barriers;
    }
    report.whole = report.whole && !(input_.obsolete && input_.obsolete());
    const bool leftOut = !report.whole && !lasting_[step];
    if (!cadence_->runs(step) || leftOut) {
      if (planned.barriersAfterClears) glMemoryBarrier(glBarriersOf(planned.barriersAfterClears));
      lookThroughTap(step, report);
      continue;
    }
    ran_[step] = 1;
    runStep(step, diagnostics);
    lookThroughTap(step, report);
  }
  cadence_->endFrame(own_, generationsBefore_, generations_);
}

void Execution::lookThroughTap(std::size_t step, const FrameReport& report) {
  if (step != tapStep_ || !report.whole) return;
  tap_();
  states_.forget();
}

// What spread jobs finished in the frame before becomes what everybody sees.
bool Execution::publishFinished() {
  bool any = false;
  for (std::uint32_t job = 0; job < plan_->jobs.spread.size(); ++job) {
    if (!cadence_->isFinished(job) || cadence_->isHeld(job)) continue;
    for (std::uint32_t r = 0; r < generations_.size(); ++r)
      if ((*pool_)[r].job == job) publish(r);
    publishImports(job);
    cadence_->markPublished(job);
    any = true;
  }
  return any;
}

void Execution::publish(std::uint32_t resource) {
  GpuResource& mine = (*pool_)[resource];
  if (mine.copies > 1) mine.current = (mine.current + 1) % mine.copies;
  ++mine.publications;
  const bool beforeFirst = input_.headless && framesRun_ == 0;
  mine.publishedAt = beforeFirst ? -std::numeric_limits<double>::infinity() : input_.time;
  generations_[resource] = nextGeneration_++;
}

void Execution::refreshImports(base::Diagnostics& diagnostics) {
  const graph::FlatGraph& graph = *plan_->graph;
  for (std::size_t r = 0; r < graph.resources.size(); ++r) {
    const graph::FlatResource& desc = graph.resources[r];
    if (desc.import == kNone) continue;
    const graph::ImportSpec& import = graph.imports[desc.import];
    if (desc.kind == graph::ResourceKind::imported_texture) {
      GpuResource& mine = (*pool_)[r];
      mine.imported = device_.imports.texture(import, diagnostics);
      if (mine.maker == kNone && !device_.imports.isPublished(import)) device_.imports.publish(import);
    }
    generations_[r] = device_.imports.generation(import);
  }
  viewImports(diagnostics);
}

bool Execution::resetHistories(base::Diagnostics& diagnostics) {
  bool any = false;
  const graph::FlatGraph& graph = *plan_->graph;
  for (std::size_t h = 0; h < graph.histories.size(); ++h) {
    const graph::HistorySpec& history = graph.histories[h];
    std::uint64_t state = base::kHashSeed;
    for (const std::uint32_t import : history.resetImports)
      state = base::hashCombine(state, device_.imports.generation(graph.imports[import]));
    for (const std::uint32_t resource : history.resetResources)
      state = base::hashCombine(state, generations_[resource]);
    for (const graph::Value& value : history.resetValues)
      for (const double x : value.v) state = base::hashCombine(state, std::bit_cast<std::uint64_t>(x));
    const bool changed = framesRun_ > 0 && state != resetState_[h];
    resetState_[h] = state;
    if (!changed) continue;
    any = true;
    GpuResource& resource = (*pool_)[history.resource];
    resource.publications = 0;
    ++resource.resets;
    pool_->fill(*plan_, history.resource, history.first, diagnostics);
  }
  return any;
}

// Seconds since a resource was published. Not published yet: about to be. A headless run publishes everything before
// its frame 0. What no live pass writes is never published, and counts as old as that.
double Execution::ageOf(std::uint32_t r) const {
  if (!made_[r]) return std::numeric_limits<double>::infinity();
  const GpuResource& resource = (*pool_)[r];
  if (resource.publications == 0 || publishing_[r])
    return input_.headless && framesRun_ == 0 ? std::numeric_limits<double>::infinity() : 0.0;
  return std::max(0.0, input_.time - resource.publishedAt);
}

void Execution::refreshUniforms(bool alwaysOnly) {
  const graph::FlatGraph& graph = *plan_->graph;
  for (std::size_t step = 0; step < passes_.size(); ++step) {
    PreparedPass& pass = passes_[step];
    if (!pass.usable) continue;
    const bool timeless = graph.passes[plan_->steps[step].pass].cadence != graph::Cadence::always;
    if (alwaysOnly && timeless) continue;
    for (const DynamicUniform& uniform : pass.dynamics) {
      const graph::Value value =
          uniform.expr.evaluateFolded([this](std::uint32_t key) { return ageOf(key); }, parameters_);
      std::byte* at = uniformBytes_.data() + pass.parametersOffset;
      std::byte before[32];
      std::memcpy(before, at + uniform.member.offset, 16);
      writeValue(at, uniform.member, value);
      uniformsDirty_ |= std::memcmp(before, at + uniform.member.offset, 16) != 0;
    }
    if (pass.viewBlock) {
      const graph::PassSpec& spec = *pass.context.spec;
      const graph::ImportSpec* import = spec.view == kNone ? nullptr : &graph.imports[spec.view];
      const scene::ViewData& view = device_.imports.view(import, graph.screenWidth, graph.screenHeight);
      writeView(uniformBytes_.data() + pass.viewOffset, *pass.viewBlock, view,
                {static_cast<float>(pass.width), static_cast<float>(pass.height)}, timeless);
      uniformsDirty_ = true;
    }
  }
}

void Execution::refreshOwnHashes() {
  for (std::size_t step = 0; step < passes_.size(); ++step) {
    const PreparedPass& pass = passes_[step];
    if (plan_->graph->passes[plan_->steps[step].pass].cadence == graph::Cadence::always) continue;
    std::uint64_t own = pass.programHash;
    const auto mix = [&](std::uint32_t offset, const gl::Block* block) {
      if (!block) return;
      const auto* bytes = reinterpret_cast<const char*>(uniformBytes_.data() + offset);
      own = base::hashBytes({bytes, block->bytes}, own);
    };
    mix(pass.parametersOffset, pass.parametersBlock);
    mix(pass.viewOffset, pass.viewBlock);
    for (const std::uint32_t resource : pass.written)
      own = base::hashCombine(own, (*pool_)[resource].serial + ((*pool_)[resource].resets << 40));
    // An import that is shown later than it changes.
    for (const std::uint32_t resource : pass.read)
      if (const std::uint32_t maker = (*pool_)[resource].maker; maker != kNone && maker != pass.job)
        own = base::hashCombine(own, device_.imports.publications(
                                         plan_->graph->imports[plan_->graph->resources[resource].import]));
    for (const std::uint32_t axis : pass.context.spec->threads) own = base::hashCombine(own, axis);
    own_[step] = own;
  }
}

// What the first running writer of a resource in a frame does to it: turns its history by one and publishes. A spread
// job's does neither.
void Execution::rotateWritten(const PreparedPass& pass) {
  for (const std::uint32_t r : pass.written) {
    if ((*pool_)[r].job != kNone) continue;
    if (rotated_[r]) {
      generations_[r] = nextGeneration_++;
      continue;
    }
    rotated_[r] = 1;
    publish(r);
  }
}

// Which part of its work each pass does in this frame, for the pass type and for the shader.
void Execution::refreshSlices() {
  for (std::size_t step = 0; step < passes_.size(); ++step) {
    PreparedPass& pass = passes_[step];
    if (!cadence_->runs(step)) continue;
    const SliceRange range = cadence_->slices(step);
    pass.context.slice = range.first;
    pass.context.sliceCount = range.count;
    pass.context.slices = range.of;
    if (!pass.sliceBlock) continue;
    const passes::WorkGroups groups = passes::workGroupsOf(pass.context);
    std::byte* at = uniformBytes_.data() + pass.sliceOffset;
    for (const gl::BlockMember& member : pass.sliceBlock->members) {
      graph::Value value{graph::Value::Type::list, 3, {}, {}};
      for (std::size_t axis = 0; axis < 3; ++axis)
        value.v[axis] =
            groups.first[axis] * (member.name == "first_group" ? 1u : pass.context.groupSize[axis]);
      std::byte before[32];
      std::memcpy(before, at + member.offset, 12);
      writeValue(at, member, value);
      uniformsDirty_ |= std::memcmp(before, at + member.offset, 12) != 0;
    }
  }
}

}  // namespace weft::runtime
