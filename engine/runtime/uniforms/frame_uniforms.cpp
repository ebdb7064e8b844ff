#include "engine/runtime/uniforms/frame_uniforms.h"

#include "engine/passes/compute/work_groups.h"
#include "engine/runtime/prepare/prepare.h"

namespace weft::runtime {

bool FrameUniforms::layOut(std::span<PreparedPass> passes, base::Diagnostics& diagnostics) {
  if (!arena_.layOut(passes, diagnostics)) return false;
  values_.fill(passes, arena_);
  return true;
}

void FrameUniforms::refresh(std::span<PreparedPass> passes, const std::function<double(std::uint32_t)>& ageOf,
                            bool alwaysOnly) {
  const graph::FlatGraph& graph = *plan_.graph;
  for (std::size_t step = 0; step < passes.size(); ++step) {
    PreparedPass& pass = passes[step];
    const bool timeless = graph.passes[plan_.steps[step].pass].cadence != graph::Cadence::always;
    if (!pass.usable || (alwaysOnly && timeless)) continue;
    values_.refresh(pass, ageOf, arena_);
    if (const graph::Expr& timed = pass.context.spec->timedInstances; timed.present())
      pass.context.instances = instancesAt(timed, ageOf);
    if (!pass.viewBlock) continue;
    const scene::ViewData& view = imports_.view(graph, *pass.context.spec, pass.width, pass.height);
    arena_.writeView(pass.viewOffset, *pass.viewBlock, view,
                     {static_cast<float>(pass.width), static_cast<float>(pass.height)}, timeless);
  }
}

void FrameUniforms::setSlices(PreparedPass& pass, const SliceRange& range) {
  pass.context.slice = range.first;
  pass.context.sliceCount = range.count;
  pass.context.slices = range.of;
  if (!pass.sliceBlock) return;
  const passes::WorkGroups groups = passes::workGroupsOf(pass.context);
  for (const gl::BlockMember& member : pass.sliceBlock->members) {
    graph::Value value{graph::Value::Type::list, 3, {}, {}};
    for (std::size_t axis = 0; axis < 3; ++axis)
      value.v[axis] = groups.first[axis] * (member.name == "first_group" ? 1u : pass.context.groupSize[axis]);
    arena_.write(pass.sliceOffset, member, value);
  }
}

}  // namespace weft::runtime
