#include "engine/runtime/frame/execution.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/graph/language/expr_node.h"
#include "engine/runtime/frame/renderer.h"
#include "engine/runtime/storage/formats.h"
#include "engine/text/hash.h"

namespace weft::runtime {

using graph::FlatUse;
using graph::kNone;

namespace {

// Visits every resource whose age the folded expression asks for, also in branches that are not taken.
void forEachAge(const graph::ExprNode& node, const std::function<void(std::uint32_t)>& visit) {
  if (node.op == graph::ExprOp::age_key) visit(node.key);
  for (const auto& child : node.children) forEachAge(*child, visit);
}

// Whether a draw with these instances draws none in any frame, because what they depend on was published before the first.
bool drawsNothing(const graph::Expr& instances, std::span<const std::uint8_t> still) {
  if (!instances.present()) return false;
  bool steady = true;
  forEachAge(*instances.root(), [&](std::uint32_t resource) { steady &= still[resource] != 0; });
  return steady &&
         instancesAt(instances, [](std::uint32_t) { return std::numeric_limits<double>::infinity(); }) == 0;
}

}  // namespace

std::uint64_t hashOf(const PreparedPass& pass, graph::Cadence cadence, ResourcePool& pool, Imports& imports,
                     const FrameUniforms& uniforms) {
  const std::uint64_t own = ownHashOf(pass, cadence, pool, imports);
  std::uint64_t hash = pass.programHash;
  for (const std::uint32_t resource : pass.written) hash = text::hashCombine(hash, pool[resource].resets);
  if (cadence == graph::Cadence::every) return hash + own;  // whatever it reads
  hash = uniforms.hash(pass.parametersOffset, pass.parametersBlock, hash);
  hash = uniforms.hash(pass.viewOffset, pass.viewBlock, hash);
  // Adds the imports that this pass sees later than they change.
  for (const std::uint32_t resource : pass.read)
    if (const std::uint32_t publisher = pool[resource].publisher;
        publisher != kNone && publisher != pass.group)
      hash = text::hashCombine(hash, pool[resource].shows);
  for (const std::uint32_t axis : pass.context.spec->threads) hash = text::hashCombine(hash, axis);
  if (pass.list >= 0) hash = text::hashCombine(hash, static_cast<std::uint64_t>(pass.list));
  return hash + own;
}

std::uint64_t ownHashOf(const PreparedPass& pass, graph::Cadence cadence, const ResourcePool& pool,
                        Imports& imports) {
  std::uint64_t hash = text::kHashSeed;
  for (const std::uint32_t resource : pass.written) hash = text::hashCombine(hash, pool[resource].serial);
  if (cadence == graph::Cadence::every || pass.list < 0) return hash;
  const auto list = static_cast<scene::DrawList>(pass.list);
  imports::SceneTables& tables = imports.tables();
  return text::hashCombine(hash, pass.meshes ? tables.meshFrame().generation(list) : tables.generation(list));
}

std::unique_ptr<Execution> Execution::create(Device& device, std::shared_ptr<const graph::Plan> plan,
                                             Execution* before, ShaderFiles files,
                                             text::Diagnostics& diagnostics) {
  auto prepared =
      preparePlan(device, std::move(plan), before ? &before->prepared_ : nullptr, files, diagnostics);
  if (!prepared || diagnostics.hasErrors()) return nullptr;
  std::unique_ptr<Execution> made(new Execution(device, *std::move(prepared), before));
  const bool good = made->readBack_.prepare(made->plan(), made->prepared_.passes,
                                            before ? &before->readBack_ : nullptr, diagnostics) &&
                    made->uniforms_.layOut(made->prepared_.passes, diagnostics);
  return good ? std::move(made) : nullptr;
}

Execution::Execution(Device& device, PreparedPlan prepared, const Execution* before)
    : device_(device),
      prepared_(std::move(prepared)),
      uniforms_(plan(), device.imports,
                static_cast<std::uint32_t>(std::max(16, device.context.device().uniformOffsetAlignment))),
      steps_(plan(), before ? &before->steps_ : nullptr),
      hashes_(prepared_.passes.size()),
      publications_(plan(), *prepared_.pool, device.imports, steps_, prepared_.passes,
                    before ? &before->publications_ : nullptr),
      runner_(plan(), device, *prepared_.pool, uniforms_) {}

FrameReport Execution::frame(const World& world, const FrameInput& input, text::Diagnostics& diagnostics) {
  FrameReport report;
  beginFrame(world, input);
  publishFinished(diagnostics);
  uniforms_.refresh(prepared_.passes, publications_.ages(), false);
  for (std::size_t step = 0; step < hashes_.size(); ++step)
    if (!steps_.isAlways(step))
      hashes_[step] = hashOf(prepared_.passes[step], plan().passOf(step).cadence, *prepared_.pool,
                             device_.imports, uniforms_);
  if (input.headless) runAhead(report, diagnostics);
  chooseSteps();
  runSteps(watch_, report, diagnostics);
  endFrame(report, diagnostics);
  return report;
}

void Execution::beginFrame(const World& world, const FrameInput& input) {
  input_ = input;
  device_.timers.beginFrame(static_cast<std::uint32_t>(prepared_.passes.size()));
  device_.imports.beginFrame(world, input);
  readBack_.collect();
  publications_.beginFrame(input);
  steps_.beginFrame(input.frame);
}

// What the frame before finished, and what the world changed, becomes what this frame sees.
void Execution::publishFinished(text::Diagnostics& diagnostics) {
  publications_.publishFinished();
  publications_.refreshImports(diagnostics);
  publications_.resetHistories(diagnostics);
}

// Before a headless frame, every time-sliced group that has work does all of it. A group may wait for what another
// publishes, so there are at most as many rounds as groups.
void Execution::runAhead(FrameReport& report, text::Diagnostics& diagnostics) {
  bool any = false;
  for (std::size_t round = 0; round < plan().groups.sliced.size(); ++round) {
    if (!steps_.decideAhead(hashes_, publications_.generations())) break;
    runSteps({}, report, diagnostics);
    publications_.publishFinished();
    any = true;
  }
  if (!any) return;
  uniforms_.refresh(prepared_.passes, publications_.ages(), false);  // ages
}

// All steps of the frame see what its steps will publish as new, of age 0.
void Execution::chooseSteps() {
  steps_.decide(hashes_, publications_.generations());
  if (!publications_.announce()) return;
  uniforms_.refresh(prepared_.passes, publications_.ages(), true);
}

// Skipped steps issue their barriers too, see plan.h.
void Execution::runSteps(const StepWatch& watch, FrameReport& report, text::Diagnostics& diagnostics) {
  std::vector<PreparedPass>& passes = prepared_.passes;
  publications_.beginRound();
  for (std::size_t step = 0; step < passes.size(); ++step)
    if (steps_.runs(step)) uniforms_.setSlices(passes[step], steps_.slices(step));
  lookAtMeshes();
  uniforms_.upload();
  // Publishes before any step runs, because a pass that reads x@-1 may stand before the pass that writes x.
  for (std::size_t step = 0; step < passes.size(); ++step)
    if (steps_.runs(step)) publications_.publishWritten(passes[step]);
  for (std::size_t step = 0; step < passes.size(); ++step) {
    const graph::Step& planned = plan().steps[step];
    if (planned.barriers) {
      glMemoryBarrier(glBarriersOf(planned.barriers));
      ++report.barriers;
    }
    if (steps_.runs(step)) {
      steps_.markRan(step);
      if (watch.before) watch.before(static_cast<std::uint32_t>(step));
      runner_.run(step, passes[step], steps_.slices(step).begins(), diagnostics);
    } else if (planned.barriersAfterClears) {
      glMemoryBarrier(glBarriersOf(planned.barriersAfterClears));
    }
    if (watch.after) watch.after(static_cast<std::uint32_t>(step));
  }
  steps_.endFrame(hashes_, publications_.generationsBefore(), publications_.generations());
}

void Execution::endFrame(FrameReport& report, text::Diagnostics& diagnostics) {
  device_.timers.endFrame();
  if (plan().finalBarriers) {
    glMemoryBarrier(glBarriersOf(plan().finalBarriers));
    ++report.barriers;
  }
  readBack_.copy(plan(), *prepared_.pool, runner_.framebuffers(), input_.frame, diagnostics);
  const std::size_t steps = prepared_.passes.size();
  for (std::size_t step = 0; step < steps; ++step) {
    report.passesRun += steps_.ran(step);
    report.slowRun += steps_.ran(step) && !steps_.isAlways(step);
  }
  report.passesSkipped = static_cast<std::uint32_t>(steps) - report.passesRun;
  publications_.endFrame();
}

// Finds what the views of all passes that draw meshes in this round see of the meshes.
void Execution::lookAtMeshes() {
  meshViews_.clear();
  for (std::size_t step = 0; step < prepared_.passes.size(); ++step) {
    PreparedPass& pass = prepared_.passes[step];
    if (!pass.meshes || !steps_.runs(step)) continue;
    const scene::ViewData& view =
        device_.imports.view(*plan().graph, *pass.context.spec, pass.width, pass.height);
    const bool sorted = std::ranges::any_of(pass.colors, [](const auto& color) {
      return color.second.blend.color.destination == graph::BlendFactor::one_minus_src_alpha;
    });
    meshViews_.push_back(&pass.meshes->view());
    const auto list = static_cast<scene::DrawList>(pass.list);
    const scene::MeshOrder order = sorted ? scene::MeshOrder::back_to_front : scene::MeshOrder::by_mesh;
    meshViews_.back()->look(list, view.view, view.view_projection,
                            device_.imports.tables().selectionOf(list).order.value_or(order));
  }
  if (!meshViews_.empty()) device_.imports.tables().see(meshViews_);
}

bool Execution::followsPointer() const {
  const graph::FlatGraph& graph = *plan().graph;
  for (std::size_t r = 0; r < graph.resources.size(); ++r)
    if (const std::uint32_t import = graph.resources[r].import;
        import != kNone && plan().firstStep[r] != kNone)
      if (device_.imports.of(graph.imports[import]).followsPointer()) return true;
  return false;
}

bool Execution::drawsMotion() const {
  imports::SceneTables& tables = device_.imports.tables();
  return std::ranges::any_of(prepared_.passes, [&](const PreparedPass& pass) {
    const auto list = static_cast<scene::DrawList>(pass.list);
    return pass.list >= 0 && (pass.meshes ? tables.meshFrame().isMoving(list) : tables.isMoving(list));
  });
}

gl::TextureRef Execution::texture(std::uint32_t r, std::uint32_t history) {
  text::Diagnostics ignored;
  return prepared_.pool->whole(plan(), r, (*prepared_.pool)[r].copyOf(history), ignored);
}

BufferRef Execution::buffer(std::uint32_t r, std::uint64_t& offset, std::uint32_t history) {
  const GpuResource& resource = (*prepared_.pool)[r];
  if (resource.buffers.empty()) return {};
  offset = resource.offset;
  return {resource.buffers[resource.copyOf(history)], resource.bytes};
}

gl::TextureRef Execution::presented() {
  const FlatUse& use = plan().graph->present;
  if (use.resource == kNone) return {};
  text::Diagnostics ignored;
  return prepared_.pool->view(plan(), use, (*prepared_.pool)[use.resource].copyOf(0), GL_TEXTURE_2D, ignored);
}

bool Execution::remembers(const World& world) const {
  const graph::Plan& plan = this->plan();
  const std::vector<PreparedPass>& passes = prepared_.passes;
  Imports& imports = device_.imports;
  const graph::FlatGraph& graph = *plan.graph;
  // Still are resources that only passes that are not `always` write, and imports that do not change.
  std::vector<std::uint8_t> still(graph.resources.size(), 1);
  for (std::size_t r = 0; r < still.size(); ++r)
    if (const std::uint32_t import = graph.resources[r].import; import != graph::kNone)
      still[r] = imports.of(graph.imports[import]).isStill(world);
  for (std::size_t step = 0; step < passes.size(); ++step)
    for (const graph::FlatUse& use : plan.usesOf(step))
      if (use.access != graph::Access::read && (plan.passOf(step).cadence == graph::Cadence::always ||
                                                plan.passOf(step).cadence == graph::Cadence::every))
        still[use.resource] = 0;
  for (const graph::HistorySpec& history : graph.histories) {
    const auto moves = [&](std::uint32_t import) {
      return !imports.of(graph.imports[import]).isStill(world);
    };
    const auto changes = [&](std::uint32_t resource) { return !still[resource]; };
    if (std::ranges::any_of(history.resetImports, moves) ||
        std::ranges::any_of(history.resetResources, changes))
      return true;
  }
  const scene::Camera* camera = scene::findCamera(world.scene(), "");
  const bool cameraMoves = !camera || scene::isMoving(*camera);
  const auto remembers = [&](std::uint32_t import) {
    return import != graph::kNone && imports.of(graph.imports[import]).remembers(world);
  };
  for (std::size_t step = 0; step < passes.size(); ++step) {
    const PreparedPass& pass = passes[step];
    const graph::PassSpec& spec = *pass.context.spec;
    const bool kept = plan.passOf(step).cadence != graph::Cadence::always;
    if (pass.viewBlock && remembers(spec.view)) return true;
    // What is still was published before the first frame and never again, so its history is the same in every frame, and a
    // draw that counts its instances by the age of such things draws the same number in every frame. A result that is kept
    // must be made of what is still; otherwise it matters in which frame it was made.
    const bool idle = drawsNothing(spec.timedInstances, still);
    for (const graph::FlatUse& use : plan.usesOf(step))
      if (remembers(graph.resources[use.resource].import) ||
          (!still[use.resource] && (kept || (use.history > 0 && !idle))))
        return true;
    bool unsteady = false;
    const auto look = [&](const graph::Expr& expr) {
      if (expr.present())
        forEachAge(*expr.root(), [&](std::uint32_t resource) { unsteady |= !still[resource]; });
    };
    for (const graph::UniformSpec& uniform : spec.uniforms) {
      look(uniform.dynamic);
      for (const std::uint32_t key : uniform.dynamic.parameterKeys())
        if (kept && key >= graph.parameters.size())
          unsteady |=
              !imports.of(graph.imports[graph.watched[key - graph.parameters.size()].import]).isStill(world);
    }
    look(spec.timedInstances);
    if (unsteady) return true;
    if (!kept) continue;
    if (pass.meshes
            ? scene::isMoving(world.scene())
            : pass.list >= 0 && scene::isMoving(world.scene(), imports.tables().selectionOf(
                                                                   static_cast<scene::DrawList>(pass.list))))
      return true;
    if (pass.viewBlock &&
        (plan.passOf(step).cadence == graph::Cadence::every || cameraMoves || spec.view != graph::kNone))
      return true;
  }
  return false;
}

}  // namespace weft::runtime
