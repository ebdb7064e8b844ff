#include "engine/runtime/frame/frame_memory.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <span>

#include "engine/graph/language/expr_node.h"
#include "engine/runtime/prepare/prepare.h"

namespace weft::runtime {

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

bool remembersFrames(const graph::Plan& plan, std::span<const PreparedPass> passes, Imports& imports,
                     const World& world) {
  const graph::FlatGraph& graph = *plan.graph;
  // Still are resources that only passes that are not `always` write, and imports that do not change.
  std::vector<std::uint8_t> still(graph.resources.size(), 1);
  for (std::size_t r = 0; r < still.size(); ++r)
    if (const std::uint32_t import = graph.resources[r].import; import != graph::kNone)
      still[r] = imports.isStill(graph.imports[import], world);
  for (std::size_t step = 0; step < passes.size(); ++step)
    for (const graph::FlatUse& use : plan.usesOf(step))
      if (use.access != graph::Access::read && plan.passOf(step).cadence == graph::Cadence::always)
        still[use.resource] = 0;
  // What is still was published before the first frame and never again, so its history is the same in every frame, and a
  // draw that counts its instances by the age of such things draws the same number in every frame.
  for (std::size_t step = 0; step < passes.size(); ++step) {
    if (drawsNothing(passes[step].context.spec->timedInstances, still)) continue;
    for (const graph::FlatUse& use : plan.usesOf(step))
      if (use.history > 0 && !still[use.resource]) return true;
  }
  for (const graph::HistorySpec& history : graph.histories) {
    const auto moves = [&](std::uint32_t import) { return !imports.isStill(graph.imports[import], world); };
    const auto changes = [&](std::uint32_t resource) { return !still[resource]; };
    if (std::ranges::any_of(history.resetImports, moves) ||
        std::ranges::any_of(history.resetResources, changes))
      return true;
  }
  const scene::Camera* camera = scene::findCamera(world.scene(), "");
  const bool cameraMoves = !camera || scene::isMoving(*camera);
  const auto remembers = [&](std::uint32_t import) {
    return import != graph::kNone && imports.remembers(graph.imports[import], world);
  };
  for (std::size_t step = 0; step < passes.size(); ++step) {
    const PreparedPass& pass = passes[step];
    if (pass.viewBlock && remembers(pass.context.spec->view)) return true;
    for (const graph::FlatUse& use : plan.usesOf(step))
      if (remembers(graph.resources[use.resource].import)) return true;
    bool unsteady = false;
    const auto look = [&](const graph::Expr& expr) {
      if (expr.present())
        forEachAge(*expr.root(), [&](std::uint32_t resource) { unsteady |= !still[resource]; });
    };
    for (const graph::UniformSpec& uniform : pass.context.spec->uniforms) look(uniform.dynamic);
    look(pass.context.spec->timedInstances);
    if (unsteady) return true;
    if (plan.passOf(step).cadence == graph::Cadence::always) continue;
    // A result that is kept must be made of what is still; otherwise it matters in which frame it was made.
    if (std::ranges::any_of(plan.usesOf(step),
                            [&](const graph::FlatUse& use) { return !still[use.resource]; }))
      return true;
    if (pass.meshes
            ? scene::isMoving(world.scene())
            : pass.list >= 0 && scene::isMoving(world.scene(), static_cast<scene::DrawList>(pass.list)))
      return true;
    if (pass.viewBlock && (cameraMoves || pass.context.spec->view != graph::kNone)) return true;
  }
  return false;
}

bool readsPointer(const graph::Plan& plan, Imports& imports) {
  const graph::FlatGraph& graph = *plan.graph;
  const auto follows = [&](const graph::FlatUse& use) {
    const std::uint32_t import = graph.resources[use.resource].import;
    return import != graph::kNone && imports.followsPointer(graph.imports[import]);
  };
  for (std::size_t step = 0; step < plan.steps.size(); ++step)
    if (std::ranges::any_of(plan.usesOf(step), follows)) return true;
  return false;
}

}  // namespace weft::runtime
