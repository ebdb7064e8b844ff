#include "engine/runtime/cadence/cadence.h"

#include <string_view>
#include <unordered_map>

namespace weft::runtime {

using graph::Access;
using graph::Cadence;
using graph::FlatUse;
using graph::kNone;

FrameCadence::FrameCadence(const graph::Plan& plan, const FrameCadence* before)
    : plan_(plan), ran_(plan.steps.size()) {
  const std::size_t steps = plan.steps.size();
  const std::size_t resources = plan.graph->resources.size();
  memories_.resize(steps);
  latches_.resize(steps);
  slices_.resize(steps);
  run_.assign(steps, 0);
  wants_.assign(steps, 0);
  written_.assign(resources, 0);
  blocked_.assign(resources, 0);
  alwaysWritten_.assign(resources, 0);
  groupOf_.assign(steps, kNone);
  groups_.resize(plan.groups.sliced.size());
  for (std::uint32_t s = 0; s < steps; ++s) {
    if (const Cadence cadence = plan.passOf(s).cadence;
        cadence == Cadence::always || cadence == Cadence::every)
      plan.forEachWrite(s, [&](const FlatUse& use) { alwaysWritten_[use.resource] = 1; });
    groupOf_[s] = plan.groups.groupOf(plan.steps[s].pass);
    if (groupOf_[s] != kNone) groups_[groupOf_[s]].steps.push_back(s);
  }
  for (std::size_t j = 0; j < groups_.size(); ++j) groups_[j].sliced = plan.groups.sliced[j] != 0;
  if (!before) return;
  const auto nameOf = [](const graph::Plan& of, std::size_t step) -> std::string_view {
    return of.graph->passNames[of.steps[step].pass];
  };
  std::unordered_map<std::string_view, std::size_t> stepOf;
  for (std::size_t s = 0; s < before->memories_.size(); ++s) stepOf[nameOf(before->plan_, s)] = s;
  for (std::size_t s = 0; s < steps; ++s)
    if (const auto old = stepOf.find(nameOf(plan, s)); old != stepOf.end())
      memories_[s] = before->memories_[old->second];
}

// A use of what the step's own time-sliced group writes.
bool FrameCadence::isInside(std::size_t step, std::uint32_t resource) const {
  return groupOf_[step] != kNone && plan_.groups.slicedWriterOf(resource) == groupOf_[step];
}

bool FrameCadence::differs(std::size_t step, const PassMemory& memory, bool inputs,
                           const std::vector<std::uint64_t>& own,
                           const std::vector<std::uint64_t>& generations) const {
  if (!memory.ran || memory.own != own[step]) return true;
  if (!inputs) return false;
  bool changed = false;
  std::size_t input = 0;
  for (const FlatUse& use : plan_.usesOf(step)) {
    if (use.access != Access::read) continue;
    const bool counts = use.history > 0 || !isInside(step, use.resource);
    changed |= counts && (input >= memory.inputs.size() || memory.inputs[input] != generations[use.resource]);
    ++input;
  }
  return changed;
}

bool FrameCadence::wants(std::size_t step, const std::vector<std::uint64_t>& own,
                         const std::vector<std::uint64_t>& generations) const {
  const Cadence cadence = plan_.passOf(step).cadence;
  if (cadence == Cadence::always) return true;
  if (cadence == Cadence::every && frame_ % plan_.passOf(step).period == 0) return true;
  // While a group is under way, any change of what it has read would make the rest of its result another picture, also for `once`.
  if (groupOf_[step] != kNone && (groups_[groupOf_[step]].active || groups_[groupOf_[step]].finished))
    return differs(step, latches_[step], true, own, generations);
  return differs(step, memories_[step], cadence == Cadence::on_change, own, generations);
}

// One walk over the steps in order; true when a group learned something that steps before it should have known.
bool FrameCadence::sweep(bool ahead) {
  bool again = false;
  std::fill(written_.begin(), written_.end(), std::uint8_t{0});
  for (std::size_t r = 0; r < blocked_.size(); ++r) {
    const std::uint32_t group = plan_.groups.slicedWriterOf(static_cast<std::uint32_t>(r));
    blocked_[r] = (group != kNone && !groups_[group].published) || (ahead && alwaysWritten_[r]);
  }
  for (std::size_t s = 0; s < run_.size(); ++s) {
    const Cadence cadence = plan_.passOf(s).cadence;
    if (cadence == Cadence::always) {
      run_[s] = !ahead;
      if (run_[s]) plan_.forEachWrite(s, [&](const FlatUse& use) { written_[use.resource] = 1; });
      continue;
    }
    Group* group = groupOf_[s] == kNone ? nullptr : &groups_[groupOf_[s]];
    bool woken = false, blocked = false;
    for (const FlatUse& use : plan_.usesOf(s)) {
      if (use.access != Access::read || use.history > 0 || isInside(s, use.resource)) continue;
      woken |= written_[use.resource] != 0;
      blocked |= blocked_[use.resource] != 0;
    }
    if (cadence != Cadence::on_change && !(group && (group->active || group->finished))) woken = false;
    bool want = (wants_[s] || woken) && !(ahead && cadence == Cadence::every);
    if (group) {
      if ((want && !group->wants) || (blocked && !group->blocked)) again = true;
      group->wants |= want;
      group->blocked |= blocked;
      want = group->wants;
      blocked = group->blocked;
    }
    run_[s] = want && !blocked;
    if (group && group->sliced) continue;  // what it writes is seen when it is published
    if (run_[s]) plan_.forEachWrite(s, [&](const FlatUse& use) { written_[use.resource] = 1; });
    if (want && blocked) plan_.forEachWrite(s, [&](const FlatUse& use) { blocked_[use.resource] = 1; });
  }
  return again;
}

void FrameCadence::decide(const std::vector<std::uint64_t>& own,
                          const std::vector<std::uint64_t>& generations, bool ahead) {
  for (Group& group : groups_) group.wants = group.blocked = group.started = false;
  for (std::size_t s = 0; s < run_.size(); ++s) {
    wants_[s] = wants(s, own, generations);
    slices_[s] = {};
  }
  while (sweep(ahead)) {
  }
  for (Group& group : groups_) {
    if (!group.sliced) continue;
    for (const std::uint32_t s : group.steps) run_[s] = 0;
    if (group.blocked) {
      group.active = group.finished = false;
      continue;
    }
    if (group.wants || (ahead && group.active)) {  // it starts again: nothing that is half done is kept
      group.active = group.started = true;
      group.finished = false;
      group.at = group.slice = 0;
    }
    if (group.active) takeTurn(group, ahead);
  }
}

// Lets the group's next slice run, with the passes without slices that follow it; `whole`: all of its passes.
void FrameCadence::takeTurn(Group& group, bool whole) {
  const auto slicesOf = [&](std::uint32_t at) { return plan_.passOf(group.steps[at]).slices; };
  const auto end = static_cast<std::uint32_t>(group.steps.size());
  do {
    const std::uint32_t step = group.steps[group.at], of = std::max(1u, slicesOf(group.at));
    run_[step] = 1;
    slices_[step] = whole ? SliceRange{} : SliceRange{group.slice, 1, of};
    if (!whole && ++group.slice < of) return;
    group.slice = 0;
    ++group.at;
  } while (group.at < end && (whole || slicesOf(group.at) == 0));
  if (group.at < end) return;
  group.active = false;
  group.finished = true;
}

bool FrameCadence::decideAhead(const std::vector<std::uint64_t>& own,
                               const std::vector<std::uint64_t>& generations) {
  if (plan_.groups.ofResource.empty()) return false;
  decide(own, generations, true);
  for (std::uint32_t group = 0; group < groups_.size(); ++group)
    if (groups_[group].sliced && groups_[group].finished) return true;
  std::fill(run_.begin(), run_.end(), std::uint8_t{0});
  return false;
}

void FrameCadence::take(std::size_t step, PassMemory& memory, std::uint64_t own,
                        const std::vector<std::uint64_t>& before,
                        const std::vector<std::uint64_t>& after) const {
  std::size_t input = 0;
  for (const FlatUse& use : plan_.usesOf(step)) {
    if (use.access != Access::read) continue;
    if (input == memory.inputs.size()) memory.inputs.push_back(0);
    memory.inputs[input++] = (use.history ? before : after)[use.resource];
  }
  memory.ran = true;
  memory.own = own;
}

void FrameCadence::endFrame(const std::vector<std::uint64_t>& own, const std::vector<std::uint64_t>& before,
                            const std::vector<std::uint64_t>& after) {
  for (std::size_t s = 0; s < run_.size(); ++s) {
    const Group* group = groupOf_[s] == kNone ? nullptr : &groups_[groupOf_[s]];
    if (!group || !group->sliced) {
      if (run_[s]) take(s, memories_[s], own[s], before, after);
    } else if (group->started) {
      take(s, latches_[s], own[s], before, after);
    }
  }
}

void FrameCadence::carry(StateStream& state, std::span<const std::uint64_t> own,
                         const std::function<std::optional<std::uint64_t>(std::uint32_t)>& importOf) {
  for (std::size_t s = 0; s < run_.size(); ++s)
    for (PassMemory* memory : {&memories_[s], &latches_[s]}) {
      const auto reads =
          static_cast<std::size_t>(std::ranges::count(plan_.usesOf(s), Access::read, &FlatUse::access));
      bool whole = memory->inputs.size() >= reads;
      state.carry(memory->ran);
      if (!memory->ran) continue;  // the rest says nothing
      state.carryFrom(own[s], memory->own);
      state.carry(whole);
      memory->inputs.resize(whole ? reads : 0);
      std::size_t input = 0;
      for (const FlatUse& use : plan_.usesOf(s)) {
        if (!whole || use.access != Access::read) continue;
        std::uint64_t& seen = memory->inputs[input++];
        const auto now = importOf(use.resource);
        bool same = seen == now;
        now ? state.carry(same) : state.carry(seen);
        if (now && state.loading()) seen = same ? *now : *now - 1;
      }
    }
  for (Group& group : groups_) {
    for (bool* each : {&group.active, &group.finished, &group.published}) state.carry(*each);
    state.carry(group.at);
    state.carry(group.slice);
    const bool turn = group.at < group.steps.size() &&
                      group.slice < std::max(1u, plan_.passOf(group.steps[group.at]).slices);
    state.require(turn || !group.active);
    state.require(group.sliced || (!group.active && !group.finished));
  }
}

void FrameCadence::markPublished(std::uint32_t index) {
  Group& group = groups_[index];
  group.finished = false;
  group.published = true;
  for (const std::uint32_t s : group.steps) {
    memories_[s].ran = true;
    memories_[s].own = latches_[s].own;
    memories_[s].inputs.assign(latches_[s].inputs.begin(), latches_[s].inputs.end());
  }
}

}  // namespace weft::runtime
