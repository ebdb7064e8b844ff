// A frame: what changed, what runs, what is issued. Preparing stands in execution_prepare.cpp.
#include "engine/runtime/frame/execution.h"

#include <algorithm>

#include "engine/base/hash.h"
#include "engine/passes/compute/work_groups.h"
#include "engine/runtime/storage/formats.h"

namespace weft::runtime {

using graph::Cadence;
using graph::kNone;

FrameReport Execution::frame(const World& world, const FrameInput& input, base::Diagnostics& diagnostics) {
  FrameReport report;
  beginFrame(world, input);
  publishFinished(diagnostics);
  refreshUniforms(false);
  refreshHashes();
  if (input.headless) runAhead(report, diagnostics);
  decide(diagnostics);
  runSteps(report, diagnostics);
  endFrame(report, diagnostics);
  return report;
}

void Execution::beginFrame(const World& world, const FrameInput& input) {
  input_ = input;
  runner_->forgetState();
  device_.timers.beginFrame(static_cast<std::uint32_t>(passes_.size()));
  device_.imports.beginFrame(world, input);
  readBack_.collect();
  publications_->beginFrame(input);
  std::fill(ran_.begin(), ran_.end(), std::uint8_t{0});
}

// What the frame before finished, and what the world changed, becomes what this frame sees.
void Execution::publishFinished(base::Diagnostics& diagnostics) {
  chooseVariants(false, diagnostics);
  publications_->holdFading();
  bool aged = publications_->publishFinished();
  publications_->refreshImports(diagnostics);
  aged |= publications_->resetHistories(diagnostics);
  if (aged) chooseVariants(false, diagnostics);
}

// Every time-sliced group that has something to do does all of it before the frame. A group may wait for what another
// publishes, so at most as many rounds as there are groups.
void Execution::runAhead(FrameReport& report, base::Diagnostics& diagnostics) {
  bool any = false;
  for (std::size_t round = 0; round < plan_->groups.sliced.size(); ++round) {
    if (!cadence_->decideAhead(hashes_, publications_->generations())) break;
    ahead_ = true;
    runSteps(report, diagnostics);
    ahead_ = false;
    publications_->publishFinished();
    publications_->viewImports(diagnostics);
    runner_->forgetState();  // an upload may have changed it
    any = true;
  }
  if (!any) return;
  chooseVariants(false, diagnostics);  // ages
  refreshUniforms(false);
}

// Which passes run. What they publish is new to all that runs in the same frame.
void Execution::decide(base::Diagnostics& diagnostics) {
  cadence_->decide(hashes_, publications_->generations());
  if (!publications_->announce()) return;
  publications_->viewImports(diagnostics);
  chooseVariants(true, diagnostics);
  refreshUniforms(true);
}

// Barriers are issued of skipped steps too, see plan.h.
void Execution::runSteps(FrameReport& report, base::Diagnostics& diagnostics) {
  publications_->beginRound();
  refreshSlices();
  lookAtMeshes();
  arena_.upload();
  // Before any step: a pass that reads x@-1 may stand before the one that writes x.
  for (std::size_t step = 0; step < passes_.size(); ++step)
    if (runs(step)) publications_->publishWritten(passes_[step]);
  for (std::size_t step = 0; step < passes_.size(); ++step) {
    const graph::Step& planned = plan_->steps[step];
    if (planned.barriers) {
      glMemoryBarrier(glBarriersOf(planned.barriers));
      ++report.barriers;
    }
    report.whole = report.whole && !(input_.obsolete && input_.obsolete());
    if (runs(step) && (report.whole || lasting_[step])) {
      ran_[step] = 1;
      look(watch_.before, step);
      runner_->run(step, passes_[step], cadence_->slices(step).begins(), diagnostics);
    } else if (planned.barriersAfterClears) {
      glMemoryBarrier(glBarriersOf(planned.barriersAfterClears));
    }
    if (report.whole) look(watch_.after, step);
  }
  cadence_->endFrame(hashes_, publications_->generationsBefore(), publications_->generations());
}

void Execution::endFrame(FrameReport& report, base::Diagnostics& diagnostics) {
  publications_->releaseImports();
  device_.timers.endFrame();
  if (plan_->finalBarriers) {
    glMemoryBarrier(glBarriersOf(plan_->finalBarriers));
    ++report.barriers;
  }
  if (report.whole) readBack_.copy(*plan_, *pool_, runner_->framebuffers(), input_.frame, diagnostics);
  for (std::size_t step = 0; step < ran_.size(); ++step) {
    report.passesRun += ran_[step];
    report.slowRun += ran_[step] && cadenceOf(step) != Cadence::always;
  }
  report.passesSkipped = static_cast<std::uint32_t>(passes_.size()) - report.passesRun;
  publications_->endFrame();
}

void Execution::look(const std::function<void(std::uint32_t step)>& watcher, std::size_t step) {
  if (!watcher || ahead_ || (watch_.only != kNone && step != watch_.only)) return;
  watcher(static_cast<std::uint32_t>(step));
  runner_->forgetState();
}

void Execution::chooseVariants(bool alwaysOnly, base::Diagnostics& diagnostics) {
  if (!variants_->choose(publications_->ages(), alwaysOnly, diagnostics)) return;
  layOutUniforms(diagnostics);
  refreshUniforms(false);
}

void Execution::layOutUniforms(base::Diagnostics& diagnostics) {
  const std::span<PreparedPass* const> all = variants_->all();
  arena_.layOut(all, diagnostics);
  values_.fill(all, arena_);
}

// What changes from frame to frame: values of age(), and the View block.
void Execution::refreshUniforms(bool alwaysOnly) {
  const graph::FlatGraph& graph = *plan_->graph;
  for (std::size_t step = 0; step < passes_.size(); ++step) {
    const PreparedPass& pass = passes_[step];
    const bool timeless = cadenceOf(step) != Cadence::always;
    if (!pass.usable || (alwaysOnly && timeless)) continue;
    values_.refresh(pass, publications_->ages(), arena_);
    if (!pass.viewBlock) continue;
    const scene::ViewData& view = device_.imports.view(graph, *pass.context.spec, pass.width, pass.height);
    arena_.writeView(pass.viewOffset, *pass.viewBlock, view,
                     {static_cast<float>(pass.width), static_cast<float>(pass.height)}, timeless);
  }
}

// What a pass that is not `always` is made of, besides the generations of what it reads.
void Execution::refreshHashes() {
  for (std::size_t step = 0; step < passes_.size(); ++step) {
    if (cadenceOf(step) == Cadence::always) continue;
    const PreparedPass& pass = passes_[step];
    std::uint64_t hash = pass.programHash;
    hash = arena_.hash(pass.parametersOffset, pass.parametersBlock, hash);
    hash = arena_.hash(pass.viewOffset, pass.viewBlock, hash);
    for (const std::uint32_t resource : pass.written)
      hash = base::hashCombine(hash, (*pool_)[resource].serial + ((*pool_)[resource].resets << 40));
    // An import that is shown later than it changes.
    for (const std::uint32_t resource : pass.read)
      if (const std::uint32_t publisher = (*pool_)[resource].publisher;
          publisher != kNone && publisher != pass.group)
        hash = base::hashCombine(hash, device_.imports.publications(
                                           plan_->graph->imports[plan_->graph->resources[resource].import]));
    for (const std::uint32_t axis : pass.context.spec->threads) hash = base::hashCombine(hash, axis);
    if (pass.list >= 0)
      hash = base::hashCombine(
          hash, device_.imports.generation(static_cast<scene::DrawList>(pass.list), pass.meshes != nullptr));
    hashes_[step] = hash;
  }
}

// What the views of all passes that will draw meshes see of them.
void Execution::lookAtMeshes() {
  views_.clear();
  for (std::size_t step = 0; step < passes_.size(); ++step) {
    PreparedPass& pass = passes_[step];
    if (!pass.meshes || !runs(step)) continue;
    const scene::ViewData& view =
        device_.imports.view(*plan_->graph, *pass.context.spec, pass.width, pass.height);
    const bool sorted = std::ranges::any_of(pass.blends, [](const auto& blend) {
      return blend.second == graph::Blend::premultiplied || blend.second == graph::Blend::alpha;
    });
    views_.push_back(&pass.meshes->view());
    views_.back()->look(static_cast<scene::DrawList>(pass.list), view.view, view.view_projection,
                        sorted ? scene::MeshOrder::back_to_front : scene::MeshOrder::by_mesh);
  }
  if (!views_.empty()) device_.imports.tables().see(views_);
}

bool Execution::drawsMotion() {
  return std::ranges::any_of(passes_, [&](const PreparedPass& pass) {
    return pass.usable && !pass.idle && pass.list >= 0 &&
           device_.imports.isMoving(static_cast<scene::DrawList>(pass.list), pass.meshes != nullptr);
  });
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
    for (const gl::BlockMember& member : pass.sliceBlock->members) {
      graph::Value value{graph::Value::Type::list, 3, {}, {}};
      for (std::size_t axis = 0; axis < 3; ++axis)
        value.v[axis] =
            groups.first[axis] * (member.name == "first_group" ? 1u : pass.context.groupSize[axis]);
      arena_.write(pass.sliceOffset, member, value);
    }
  }
}

}  // namespace weft::runtime
