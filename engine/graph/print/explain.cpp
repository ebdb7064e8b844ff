#include "engine/graph/print/explain.h"

#include <algorithm>

#include "engine/graph/compile/barrier_rules.h"

namespace weft::graph {

namespace {

std::string quoted(const std::string& name) {
  return "'" + name + "'";
}

std::string span(const char* what, std::uint32_t first, std::uint32_t count) {
  std::string text = std::string(".") + what + "[" + std::to_string(first);
  if (count > 1) text += ".." + std::to_string(first + count - 1);
  return text + "]";
}

std::string stepsRange(const Plan& plan, std::uint32_t resource) {
  const std::uint32_t first = plan.firstStep[resource], last = plan.lastStep[resource];
  const std::string end = last == plan.steps.size() ? "end" : std::to_string(last);
  return first == last ? "step " + end : "steps " + std::to_string(first) + ".." + end;
}

}  // namespace

std::string textOf(const FlatGraph& graph, const FlatUse& use) {
  const FlatResource& r = graph.resources[use.resource];
  std::string text = graph.resourceNames[use.resource];
  if (!isBuffer(r)) {
    if (use.mips < r.mips) text += span("mip", use.mip, use.mips);
    if (use.layers < r.layers) text += span("layer", use.layer, use.layers);
    if (planesOf(r) == 2 && (use.planes & 3) == 1) text += ".depth";
    if (planesOf(r) == 2 && (use.planes & 3) == 2) text += ".stencil";
  }
  if (use.history > 0) text += "@-" + std::to_string(use.history);
  return text;
}

std::string barrierText(std::uint16_t mask) {
  std::string text;
  for (int i = 0; i < kBarrierBitCount; ++i)
    if ((mask >> i & 1) != 0)
      text += (text.empty() ? "" : " ") + std::string(barrierName(static_cast<BarrierBit>(1 << i)));
  return text;
}

Explainer::Explainer(const Plan& plan)
    : plan_(plan),
      graph_(*plan.graph),
      edges_(dependencies(*plan.graph)),
      from_(graph_.passes.size()),
      to_(graph_.passes.size()) {
  for (std::uint32_t i = 0; i < edges_.size(); ++i) {
    from_[edges_[i].from].push_back(i);
    to_[edges_[i].to].push_back(i);
  }
}

std::string Explainer::whyPass(std::uint32_t pass) const {
  const FlatPass& p = graph_.passes[pass];
  const bool live = plan_.stepOf[pass] != kNone;
  if (live && p.sideEffect) return "runs: it has a side effect";
  const auto writes = [&](std::uint32_t resource, bool attachedOnly) {
    for (std::uint32_t u = p.firstUse; u < p.firstUse + p.useCount; ++u)
      if (graph_.uses[u].resource == resource && graph_.uses[u].access != Access::read &&
          (!attachedOnly || plan_.attached[u] != 0))
        return true;
    return false;
  };
  const auto reader = [&](bool liveReader) -> const Dependency* {
    for (const std::uint32_t i : from_[pass])
      if (edges_[i].type == Dependency::Type::read_after_write &&
          (plan_.stepOf[edges_[i].to] != kNone) == liveReader &&
          (!liveReader || writes(edges_[i].resource, true)))
        return &edges_[i];
    return nullptr;
  };
  const auto name = [&](std::uint32_t resource) { return quoted(graph_.resourceNames[resource]); };
  if (live) {
    if (graph_.present.resource != kNone && writes(graph_.present.resource, true))
      return "runs: " + name(graph_.present.resource) + " is presented";
    if (const Dependency* edge = reader(true))
      return "runs: " + quoted(graph_.passNames[edge->to]) + " reads " + name(edge->resource);
    for (std::uint32_t u = p.firstUse; u < p.firstUse + p.useCount; ++u) {
      const FlatUse& use = graph_.uses[u];
      if (plan_.attached[u] != 0 && use.access != Access::read && graph_.resources[use.resource].history > 0)
        return "runs: a later frame reads " + name(use.resource);
    }
    return "runs";
  }
  if (const Dependency* edge = reader(false))
    return "culled: " + name(edge->resource) + " is read only by culled passes, " +
           quoted(graph_.passNames[edge->to]) + " first";
  for (const std::uint32_t i : from_[pass])
    if (edges_[i].type == Dependency::Type::write_after_write)
      return "culled: " + quoted(graph_.passNames[edges_[i].to]) + " overwrites " + name(edges_[i].resource) +
             " before anything reads it";
  for (std::uint32_t u = p.firstUse; u < p.firstUse + p.useCount; ++u)
    if (graph_.uses[u].access != Access::read)
      return "culled: nothing reads " + name(graph_.uses[u].resource);
  return "culled: it writes nothing and has no side effect";
}

std::string Explainer::whyHere(std::uint32_t pass) const {
  std::string text;
  for (const std::uint32_t i : to_[pass]) {
    const Dependency& edge = edges_[i];
    if (plan_.stepOf[edge.from] == kNone) continue;
    const char* why = edge.type == Dependency::Type::read_after_write   ? "reads its "
                      : edge.type == Dependency::Type::write_after_read ? "overwrites what it reads, "
                                                                        : "overwrites its ";
    text += (text.empty() ? "after " : ", ") + quoted(graph_.passNames[edge.from]) + " (" + why +
            quoted(graph_.resourceNames[edge.resource]) + ")";
  }
  return text;
}

std::string Explainer::whyStorage(std::uint32_t resource) const {
  const FlatResource& r = graph_.resources[resource];
  if (isImported(r)) return "imported";
  if (plan_.firstStep[resource] == kNone) return "none: no live pass touches it";
  if (plan_.persistent[resource] != 0) {
    if (plan_.groups.slicedWriterOf(resource) != kNone)
      return "its own: written over several frames beside what was published, it needs " +
             std::to_string(plan_.copiesOf(resource)) + " copies";
    if (r.history > 0)
      return "its own: history of " + std::to_string(r.history) + " needs " + std::to_string(r.history + 1) +
             " copies";
    for (const Step& step : plan_.steps) {
      const FlatPass& pass = graph_.passes[step.pass];
      for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u)
        if (graph_.uses[u].resource == resource && graph_.uses[u].access != Access::read &&
            plan_.attached[u] != 0 && pass.cadence != Cadence::always)
          return "its own: " + quoted(graph_.passNames[step.pass]) + " does not write it in every frame";
    }
  }
  std::string others;
  for (std::uint32_t q = 0; q < graph_.resources.size(); ++q) {
    if (q == resource || plan_.firstStep[q] == kNone) continue;
    bool shares = plan_.storageOf[resource] != kNone && plan_.storageOf[q] == plan_.storageOf[resource];
    if (plan_.bufferOffsetOf[resource] != Plan::kNoOffset && plan_.bufferOffsetOf[q] != Plan::kNoOffset)
      shares = plan_.bufferOffsetOf[q] < plan_.bufferOffsetOf[resource] + r.bytes &&
               plan_.bufferOffsetOf[resource] < plan_.bufferOffsetOf[q] + graph_.resources[q].bytes;
    if (shares)
      others +=
          (others.empty() ? "" : ", ") + quoted(graph_.resourceNames[q]) + " (" + stepsRange(plan_, q) + ")";
  }
  const std::string alive = "alive in " + stepsRange(plan_, resource);
  if (others.empty()) return "its own: " + alive + ", and nothing else of its class fits before or after";
  return "shared with " + others + ", none of which lives while it does (" + alive + ")";
}

bool Explainer::touchesSameMemory(const Touch& a, std::int64_t frameA, const Touch& b,
                                  std::int64_t frameB) const {
  const std::uint32_t ra = a.use.resource, rb = b.use.resource;
  const FlatResource &x = graph_.resources[ra], &y = graph_.resources[rb];
  if (plan_.bufferOffsetOf[ra] != Plan::kNoOffset && plan_.bufferOffsetOf[rb] != Plan::kNoOffset)
    return plan_.bufferOffsetOf[ra] < plan_.bufferOffsetOf[rb] + std::max<std::uint64_t>(1, y.bytes) &&
           plan_.bufferOffsetOf[rb] < plan_.bufferOffsetOf[ra] + std::max<std::uint64_t>(1, x.bytes);
  if (ra == rb) {
    const std::uint32_t group = plan_.groups.slicedWriterOf(ra);
    if (group == kNone) {
      if (((frameA - a.use.history) - (frameB - b.use.history)) % (x.history + 1) != 0) return false;
    } else {  // it may publish at the start of any frame from A's on, or of none
      const auto age = [&](const Touch& touch) {
        const bool inside = touch.pass != kNone && plan_.groups.groupOf(touch.pass) == group;
        return touch.use.history + (inside ? 0 : 1);
      };
      const std::int64_t copies = plan_.copiesOf(ra), turns = (age(b) - age(a) + copies) % copies;
      if (turns > frameB - frameA) return false;
    }
  } else if (plan_.storageOf[ra] == kNone || plan_.storageOf[ra] != plan_.storageOf[rb]) {
    return false;
  }
  return isBuffer(x) || overlap(a.use, b.use);
}

// Calls f(touch, bits needed after a store, is a store) for the clears, then the uses of a step (or of the
// frame's end) until f returns true.
template <class F>
bool Explainer::eachAccess(std::uint32_t step, F&& f) const {
  const auto buffer = [&](const FlatUse& use) { return isBuffer(graph_.resources[use.resource]); };
  if (step == plan_.steps.size()) {
    const auto end = [&](const FlatUse& use) {
      return f(Touch{kNone, use, false, 0}, endBits(buffer(use)), false);
    };
    if (graph_.present.resource != kNone && plan_.firstStep[graph_.present.resource] != kNone &&
        end(graph_.present))
      return true;
    for (std::size_t i = 0; i < graph_.outputs.size(); ++i)
      if (plan_.outputLive[i] != 0 && end(graph_.outputs[i])) return true;
    return false;
  }
  const Step& s = plan_.steps[step];
  for (std::uint32_t c = s.firstClear; c < s.firstClear + s.clearCount; ++c)
    if (f(Touch{s.pass, plan_.clears[c].use, true, 0}, clearBit(plan_.clears[c], buffer(plan_.clears[c].use)),
          false))
      return true;
  const FlatPass& pass = graph_.passes[s.pass];
  for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u) {
    const FlatUse& use = graph_.uses[u];
    const auto bits =
        static_cast<std::uint16_t>(useBits(use, buffer(use)) | (buffer(use) ? 0 : pass.touches));
    if (plan_.attached[u] != 0 && f(Touch{s.pass, use, false, 0}, bits, isStore(use))) return true;
  }
  return false;
}

std::vector<BarrierReason> Explainer::whyBarriers() const {
  const auto end = static_cast<std::uint32_t>(plan_.steps.size());
  const auto maskAt = [&](std::uint32_t step, bool after) -> std::uint16_t {
    if (step == end) return after ? std::uint16_t{0} : plan_.finalBarriers;
    return after ? plan_.steps[step].barriersAfterClears : plan_.steps[step].barriers;
  };
  std::int64_t deepest = 0;
  for (std::uint32_t r = 0; r < graph_.resources.size(); ++r)
    deepest = std::max<std::int64_t>(deepest, plan_.copiesOf(r) - 1);
  const std::int64_t circle = 2 * (std::int64_t{end} + 1);

  // Forward from the barrier for what comes behind it, backward for what it waits for, both up to the next
  // barrier with the same bit: what it alone keeps apart. Positions as in hazards.h, on an unrolled line.
  const auto find = [&](BarrierReason& reason, std::int64_t at) {
    const auto bit = static_cast<std::uint16_t>(reason.bit);
    const auto stepAt = [&](std::int64_t position) {
      return static_cast<std::uint32_t>((position % circle + circle) % circle / 2);
    };
    const auto frameAt = [&](std::int64_t position) {
      return position >= 0 ? position / circle : -((-position + circle - 1) / circle);
    };
    const auto isOther =
        [&](std::int64_t position) {  // another barrier with the bit, not this one in another frame
          return (position - at) % circle != 0 &&
                 (maskAt(stepAt(position), (position % 2 + 2) % 2 == 1) & bit) != 0;
        };
    const std::int64_t reach = circle * (deepest + 2);
    // Accesses of position p: odd ones are passes (behind barriersAfterClears), even ones clears (behind
    // barriers).
    for (std::int64_t after = at; after < at + reach && !isOther(after); ++after) {
      const bool found = eachAccess(stepAt(after), [&](const Touch& target, std::uint16_t bits, bool store) {
        if (target.clear != (after % 2 == 0)) return false;
        const bool waits = store && storeBit(target.use) == bit;
        if (!waits && (bits & bit) == 0) return false;
        for (std::int64_t before = at - 1; before > at - reach && !isOther(before + 1); --before) {
          if (eachAccess(stepAt(before), [&](const Touch& source, std::uint16_t, bool stored) {
                if (source.clear != ((before % 2 + 2) % 2 == 0) || (!waits && !stored) ||
                    !touchesSameMemory(source, frameAt(before), target, frameAt(after)))
                  return false;
                reason.before = source;
                reason.before.framesAgo = static_cast<std::uint32_t>(frameAt(at) - frameAt(before));
                return true;
              })) {
            reason.after = target;
            return true;
          }
        }
        return false;
      });
      if (found) return true;
    }
    return false;
  };

  std::vector<BarrierReason> reasons;
  for (std::uint32_t step = 0; step <= end; ++step)
    for (const bool after : {false, true})
      for (int i = 0; i < kBarrierBitCount; ++i) {
        if ((maskAt(step, after) >> i & 1) == 0) continue;
        BarrierReason reason;
        reason.step = step;
        reason.afterClears = after;
        reason.bit = static_cast<BarrierBit>(1 << i);
        reason.found = find(reason, 2 * std::int64_t{step} + (after ? 1 : 0));
        reasons.push_back(reason);
      }
  return reasons;
}

std::string Explainer::textOf(const Touch& touch) const {
  const std::string what = graph::textOf(graph_, touch.use);
  if (touch.pass == kNone) return "the end of the frame reads '" + what + "'";
  if (touch.clear) return "the clear before '" + graph_.passNames[touch.pass] + "' writes '" + what + "'";
  const std::string verb = touch.use.access == Access::read    ? " reads '"
                           : touch.use.access == Access::write ? " writes '"
                                                               : " modifies '";
  return "'" + graph_.passNames[touch.pass] + "'" + verb + what + "' as " + nameOf(touch.use.kind);
}

std::string Explainer::textOf(const BarrierReason& reason) const {
  const std::string name = barrierName(reason.bit);
  if (!reason.found) return name + ": a frame in which other passes are skipped needs it";
  const std::string ago = reason.before.framesAgo == 0 ? ""
                          : reason.before.framesAgo == 1
                              ? " in the frame before"
                              : " " + std::to_string(reason.before.framesAgo) + " frames before";
  return name + ": " + textOf(reason.before) + ago + ", then " + textOf(reason.after);
}

}  // namespace weft::graph
