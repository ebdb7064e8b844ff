// Lifetimes in steps, clears of version zero, persistence and the bytes each step binds: one scan of the live
// uses in execution order. Declared in steps.h.

#include "engine/graph/compile/steps.h"

namespace weft::graph {

namespace steps {

namespace {

using Scratch = CompileScratch;

// Clears what `use` touches and nothing cleared before: runs of levels per layer, equal layers merged.
void clearCells(const FlatUse& use, const FlatResource& r, Plan& plan, Scratch& scratch) {
  const std::uint32_t base = scratch.cellBase[use.resource];
  if ((scratch.flags[use.resource] & Scratch::kGranular) == 0) {
    if (scratch.cleared[base] != 0) return;
    scratch.cleared[base] = 1;
    plan.clears.push_back({wholeUse(use.resource, r, Kind::copy, Access::write)});
    return;
  }
  const std::size_t first = plan.clears.size();
  const std::uint32_t planes = planesOf(r);
  const auto takePlanes = [&](std::uint32_t mip, std::uint32_t layer) {
    std::uint8_t mask = 0;
    for (std::uint32_t plane = 0; plane < planes; ++plane) {
      if (planes == 2 && (use.planes >> plane & 1) == 0) continue;
      std::uint8_t& cell = scratch.cleared[base + indexOf({mip, layer, plane}, r)];
      if (cell == 0) mask = static_cast<std::uint8_t>(mask | 1u << plane);
      cell = 1;
    }
    return mask;
  };
  FlatUse clear = wholeUse(use.resource, r, Kind::copy, Access::write);
  clear.mips = clear.layers = 1;
  std::vector<FlatUse> row;
  for (std::uint32_t layer = use.layer; layer < std::uint32_t{use.layer} + use.layers; ++layer) {
    row.clear();
    clear.layer = static_cast<std::uint16_t>(layer);
    for (std::uint32_t mip = use.mip; mip < std::uint32_t{use.mip} + use.mips; ++mip) {
      clear.mip = static_cast<std::uint16_t>(mip);
      clear.planes = takePlanes(mip, layer);
      if (!row.empty() && row.back().planes == clear.planes && row.back().mip + row.back().mips == clear.mip)
        ++row.back().mips;
      else if (clear.planes != 0)
        row.push_back(clear);
    }
    // A row of one rectangle that continues the rectangle of the layers above it joins it.
    FlatUse* const above = plan.clears.size() > first ? &plan.clears.back().use : nullptr;
    if (above && row.size() == 1 && above->layer + above->layers == clear.layer && above->mip == row[0].mip &&
        above->mips == row[0].mips && above->planes == row[0].planes)
      ++above->layers;
    else
      for (const FlatUse& each : row) plan.clears.push_back({each});
  }
}

// Of what is presented and of the outputs, what nobody writes: it is cleared with the first use of its resource.
std::vector<const FlatUse*> unwrittenEnds(const FlatGraph& graph, const Scratch& scratch) {
  std::vector<const FlatUse*> ends;
  const auto add = [&](const FlatUse& use, std::uint32_t link) {
    if ((scratch.flags[use.resource] & Scratch::kClear) == 0) return;
    bool written = true;
    forEachVersion(graph.links, link, use, graph.resources[use.resource],
                   [&](std::uint32_t, std::uint32_t writer) { written = written && writer != kNone; });
    if (!written) ends.push_back(&use);
  };
  if (graph.present.resource != kNone) add(graph.present, graph.links.present);
  for (std::size_t i = 0; i < graph.outputs.size(); ++i) add(graph.outputs[i], graph.links.outputs[i]);
  return ends;
}

// Which of the clears go through the framebuffer of their pass.
void findAttachedClears(const FlatGraph& graph, const Step& step, Plan& plan) {
  const FlatPass& pass = graph.passes[step.pass];
  for (std::uint32_t c = step.firstClear; c < plan.clears.size(); ++c) {
    const FlatUse& clear = plan.clears[c].use;
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u) {
      const FlatUse& use = graph.uses[u];
      if (plan.attached[u] != 0 && (use.kind == Kind::color || use.kind == Kind::depth) && use.history == 0 &&
          use.resource == clear.resource && use.mip == clear.mip && clear.mips == 1 && use.mips == 1 &&
          use.layer == clear.layer && use.layers == clear.layers && use.planes == clear.planes)
        plan.clears[c].attachment = u;
    }
  }
}

bool isLiveOutput(const FlatGraph& graph, std::size_t output, const Plan& plan, const Scratch& scratch) {
  const FlatUse& use = graph.outputs[output];
  const std::uint8_t flags = scratch.flags[use.resource];
  if ((flags & Scratch::kImported) != 0) return true;
  if (plan.firstStep[use.resource] == kNone) return false;
  // What nobody writes is version zero, which is there when something cleared it.
  const bool granular = (flags & Scratch::kGranular) != 0;
  const auto isCleared = [&](std::uint32_t s) {
    return (flags & Scratch::kClear) != 0 &&
           scratch.cleared[scratch.cellBase[use.resource] + (granular ? s : 0)] != 0;
  };
  bool live = true;
  forEachVersion(
      graph.links, graph.links.outputs[output], use, graph.resources[use.resource],
      [&](std::uint32_t s, std::uint32_t writer) { live = live && (writer != kNone || isCleared(s)); });
  return live;
}

}  // namespace

void findLifetimes(const FlatGraph& graph, Plan& plan, Scratch& scratch) {
  const std::size_t count = graph.resources.size();
  plan.firstStep.assign(count, kNone);
  plan.lastStep.assign(count, kNone);
  scratch.births.resize(count + 1);
  if (scratch.anyClear) scratch.cleared.assign(scratch.cellCount, 0);
  std::uint32_t* const firstStep = plan.firstStep.data();
  std::uint32_t* const births = scratch.births.data();
  std::size_t born = 0;
  // Without branches: what is read and what is written first alternates without a pattern.
  const auto touch = [&](std::uint32_t resource, std::uint32_t step) {
    const bool first = firstStep[resource] == kNone;
    firstStep[resource] = first ? step : firstStep[resource];
    births[born] = resource;
    born += first ? 1 : 0;
    plan.lastStep[resource] = step;
  };
  const std::vector<const FlatUse*> ends =
      scratch.anyClear ? unwrittenEnds(graph, scratch) : std::vector<const FlatUse*>{};
  std::uint64_t bound = 0;
  unsigned stored = 0;
  for (std::uint32_t t = 0; t < plan.steps.size(); ++t) {
    Step& step = plan.steps[t];
    const FlatPass& pass = graph.passes[step.pass];
    const std::uint8_t byCadence =
        pass.cadence == Cadence::always ? Scratch::kWrittenAlways : Scratch::kPersistent;
    step.firstClear = static_cast<std::uint32_t>(plan.clears.size());
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u) {
      if (plan.attached[u] == 0) continue;
      const FlatUse& use = graph.uses[u];
      touch(use.resource, t);
      const FlatResource& r = graph.resources[use.resource];
      const unsigned store = isStore(use) ? unsigned{Scratch::kStored} : 0u;
      const unsigned flags =
          scratch.flags[use.resource] | (use.access != Access::read ? unsigned{byCadence} : 0u) | store;
      scratch.flags[use.resource] = static_cast<std::uint8_t>(flags);
      stored |= store;
      bound += (flags & Scratch::kGranular) == 0 ? r.bytes : bytesOf(use, r);
      if ((flags & Scratch::kClear) == 0 || use.history != 0) continue;
      clearCells(use, r, plan, scratch);
      for (const FlatUse* last : ends)
        if (last->resource == use.resource) clearCells(*last, r, plan, scratch);
    }
    step.clearCount = static_cast<std::uint32_t>(plan.clears.size()) - step.firstClear;
    if (step.clearCount != 0) findAttachedClears(graph, step, plan);
  }
  plan.bytesBound = bound;
  scratch.anyStore = stored != 0;

  const auto end = static_cast<std::uint32_t>(plan.steps.size());
  const FlatUse& present = graph.present;
  if (present.resource != kNone && plan.firstStep[present.resource] != kNone) touch(present.resource, end);
  plan.outputLive.assign(graph.outputs.size(), 0);
  for (std::size_t i = 0; i < graph.outputs.size(); ++i) {
    if (!isLiveOutput(graph, i, plan, scratch)) continue;
    plan.outputLive[i] = 1;
    touch(graph.outputs[i].resource, end);
  }
  scratch.births.resize(born);
  plan.persistent.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    plan.persistent[i] = (scratch.flags[i] & Scratch::kPersistent) != 0 && plan.firstStep[i] != kNone ? 1 : 0;
}

}  // namespace steps
}  // namespace weft::graph
