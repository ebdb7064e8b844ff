#include "engine/runtime/cadence.h"

#include <algorithm>
#include <numeric>

namespace weft::runtime {

using graph::Access;
using graph::FlatPass;
using graph::FlatUse;
using graph::kNone;

namespace {

template <class Visit>
void forEachUse(const graph::Plan& plan, std::size_t step, Visit visit) {
  const FlatPass& pass = plan.graph->passes[plan.steps[step].pass];
  for (std::uint32_t i = 0; i < pass.useCount; ++i) visit(plan.graph->uses[pass.firstUse + i], pass.firstUse + i);
}

std::uint32_t rootOf(std::vector<std::uint32_t>& parents, std::uint32_t i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}

}  // namespace

FrameCadence::FrameCadence(const graph::Plan& plan) : plan_(plan) {
  const std::size_t steps = plan.steps.size();
  const std::size_t resources = plan.graph->resources.size();
  memories_.resize(steps);
  run_.assign(steps, 0);
  written_.assign(resources, 0);
  setOf_.assign(steps, kNone);

  // A resource is built jointly when it has history (one publication per frame) or when someone modifies it.
  std::vector<std::uint8_t> joint(resources, 0);
  for (std::size_t r = 0; r < resources; ++r) joint[r] = plan.graph->resources[r].history > 0;
  for (std::size_t s = 0; s < steps; ++s)
    forEachUse(plan, s, [&](const FlatUse& use, std::size_t index) {
      if (use.access == Access::modify && plan.attached[index]) joint[use.resource] = 1;
    });
  std::vector<std::uint32_t> parents(steps), firstWriter(resources, kNone);
  std::iota(parents.begin(), parents.end(), 0u);
  for (std::size_t s = 0; s < steps; ++s) {
    if (plan.graph->passes[plan.steps[s].pass].cadence == graph::Cadence::always) continue;
    forEachUse(plan, s, [&](const FlatUse& use, std::size_t index) {
      if (use.access == Access::read || !plan.attached[index] || !joint[use.resource]) return;
      std::uint32_t& first = firstWriter[use.resource];
      if (first == kNone) first = static_cast<std::uint32_t>(s);
      parents[rootOf(parents, static_cast<std::uint32_t>(s))] = rootOf(parents, first);
    });
  }
  for (std::size_t s = 0; s < steps; ++s) {
    const std::uint32_t root = rootOf(parents, static_cast<std::uint32_t>(s));
    if (root != s) setOf_[s] = setOf_[root] = root;
  }
  setRuns_.assign(steps, 0);
}

bool FrameCadence::wants(std::size_t step, std::uint64_t own, const std::vector<std::uint64_t>& generations) const {
  const graph::Cadence cadence = plan_.graph->passes[plan_.steps[step].pass].cadence;
  const PassMemory& memory = memories_[step];
  if (cadence == graph::Cadence::always || !memory.ran || memory.own != own) return true;
  if (cadence == graph::Cadence::once) return false;
  bool changed = false;
  std::size_t input = 0;
  forEachUse(plan_, step, [&](const FlatUse& use, std::size_t) {
    if (use.access != Access::read) return;
    changed |= input >= memory.inputs.size() || memory.inputs[input] != generations[use.resource];
    ++input;
  });
  return changed;
}

void FrameCadence::decide(const std::vector<std::uint64_t>& own, const std::vector<std::uint64_t>& generations) {
  std::fill(setRuns_.begin(), setRuns_.end(), std::uint8_t{0});
  const std::size_t steps = plan_.steps.size();
  for (std::size_t s = 0; s < steps; ++s) run_[s] = wants(s, own[s], generations);
  // What runs makes new versions, which wake later on_change passes, which may wake the rest of their set.
  for (bool again = true; again;) {
    again = false;
    std::fill(written_.begin(), written_.end(), std::uint8_t{0});
    for (std::size_t s = 0; s < steps; ++s) {
      const graph::Cadence cadence = plan_.graph->passes[plan_.steps[s].pass].cadence;
      bool woken = false;
      if (!run_[s] && cadence == graph::Cadence::on_change)
        forEachUse(plan_, s, [&](const FlatUse& use, std::size_t) {
          woken |= use.access == Access::read && use.history == 0 && written_[use.resource];
        });
      if (!run_[s] && (woken || (setOf_[s] != kNone && setRuns_[setOf_[s]]))) {
        run_[s] = 1;
        again = true;
      }
      if (!run_[s]) continue;
      if (setOf_[s] != kNone && !setRuns_[setOf_[s]]) {
        setRuns_[setOf_[s]] = 1;
        again = true;
      }
      forEachUse(plan_, s, [&](const FlatUse& use, std::size_t index) {
        if (use.access != Access::read && plan_.attached[index]) written_[use.resource] = 1;
      });
    }
  }
}

std::size_t FrameCadence::countRunning() const {
  return static_cast<std::size_t>(std::count(run_.begin(), run_.end(), std::uint8_t{1}));
}

void FrameCadence::remember(std::size_t step, std::uint64_t own, const std::vector<std::uint64_t>& before,
                            const std::vector<std::uint64_t>& after) {
  PassMemory& memory = memories_[step];
  std::size_t input = 0;
  forEachUse(plan_, step, [&](const FlatUse& use, std::size_t) {
    if (use.access != Access::read) return;
    if (input == memory.inputs.size()) memory.inputs.push_back(0);
    memory.inputs[input++] = (use.history ? before : after)[use.resource];
  });
  memory.ran = true;
  memory.own = own;
}

}  // namespace weft::runtime
