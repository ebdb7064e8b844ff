#include "engine/runtime/cadence/lasting.h"

namespace weft::runtime {

std::vector<std::uint8_t> findFrameHistories(const graph::Plan& plan) {
  const graph::FlatGraph& graph = *plan.graph;
  std::vector<std::uint8_t> found(graph.resources.size(), 0);
  for (std::size_t r = 0; r < found.size(); ++r) found[r] = graph.resources[r].history > 0;
  for (const graph::Step& step : plan.steps) {
    const graph::FlatPass& pass = graph.passes[step.pass];
    if (pass.cadence == graph::Cadence::always) continue;
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u)
      if (graph.uses[u].access != graph::Access::read) found[graph.uses[u].resource] = 0;
  }
  return found;
}

std::vector<std::uint8_t> findLastingSteps(const graph::Plan& plan) {
  const graph::FlatGraph& graph = *plan.graph;
  std::vector<std::uint8_t> lasting(plan.steps.size(), 0);
  std::vector<std::uint8_t> wanted(plan.persistent.begin(), plan.persistent.end());  // per resource
  const std::vector<std::uint8_t> ofOneFrame = findFrameHistories(plan);
  for (std::size_t r = 0; r < wanted.size(); ++r)
    if (ofOneFrame[r]) wanted[r] = 0;
  for (std::size_t step = plan.steps.size(); step-- > 0;) {
    const graph::FlatPass& pass = graph.passes[plan.steps[step].pass];
    bool lasts = pass.cadence != graph::Cadence::always || pass.sideEffect;
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u)
      lasts |=
          graph.uses[u].access != graph::Access::read && plan.attached[u] && wanted[graph.uses[u].resource];
    lasting[step] = lasts;
    if (!lasts) continue;
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u)
      if (graph.uses[u].access != graph::Access::write) wanted[graph.uses[u].resource] = 1;
  }
  return lasting;
}

}  // namespace weft::runtime
