#include "engine/runtime/cadence/lasting.h"

namespace weft::runtime {

std::vector<std::uint8_t> findLastingSteps(const graph::Plan& plan) {
  const graph::FlatGraph& graph = *plan.graph;
  std::vector<std::uint8_t> lasting(plan.steps.size(), 0);
  std::vector<std::uint8_t> wanted(plan.persistent.begin(), plan.persistent.end());  // per resource
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
