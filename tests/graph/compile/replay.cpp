#include "tests/graph/compile/replay.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "engine/graph/subresource.h"
#include "engine/text/hash.h"

namespace weft::graph::replay {

namespace {

using text::hashCombine;

class Machine {
 public:
  Machine(const Plan& plan, bool planned) : plan_(plan), graph_(*plan.graph), planned_(planned) {}

  Shown run(std::size_t frames) {
    for (frame_ = 0; frame_ < frames; ++frame_) {
      if (planned_)
        for (const Step& step : plan_.steps) {
          for (std::uint32_t c = step.firstClear; c < step.firstClear + step.clearCount; ++c)
            clear(plan_.clears[c].use);
          runPass(step.pass);
        }
      else
        runDeclared();
      show();
    }
    std::map<std::uint32_t, std::uint64_t> last(seen_.begin(), seen_.end());
    for (const auto& [pass, symbol] : last) shown_.symbols.push_back(symbol);
    return shown_;
  }

 private:
  using Unit = std::tuple<int, std::uint64_t, std::uint64_t, std::uint64_t>;

  void runDeclared() {
    for (std::uint32_t r = 0; r < graph_.resources.size(); ++r)
      if (graph_.resources[r].hasClear) clear(wholeUse(r, graph_.resources[r], Kind::copy, Access::write));
    for (std::uint32_t p = 0; p < graph_.passes.size(); ++p) runPass(p);
  }

  bool runs(std::uint32_t use) const { return !planned_ || plan_.attached[use] != 0; }

  // Every copy of a history moves on by one each frame.
  std::uint64_t copyOf(const FlatUse& use) const {
    const std::uint64_t copies = graph_.resources[use.resource].history + 1u;
    return (frame_ + copies - use.history) % copies;
  }

  template <class F>
  void eachUnit(const FlatUse& use, F&& f) const {
    const FlatResource& r = graph_.resources[use.resource];
    if (planned_ && plan_.bufferOffsetOf[use.resource] != Plan::kNoOffset) {
      const std::uint64_t from = plan_.bufferOffsetOf[use.resource];
      for (std::uint64_t at = from / 256; at * 256 < from + std::max<std::uint64_t>(1, r.bytes); ++at)
        f(Unit{2, 0, 0, at}, 0u);
      return;
    }
    const std::uint32_t storage = planned_ ? plan_.storageOf[use.resource] : kNone;
    forEachSubresource(use, r, [&](std::uint32_t s) {
      f(storage != kNone ? Unit{0, storage, copyOf(use), s} : Unit{1, use.resource, copyOf(use), s}, s);
    });
  }

  // Untouched memory: of a persistent or imported resource something of its own, of a transient nothing in
  // particular.
  std::uint64_t load(const Unit& unit, const FlatUse& use, std::uint32_t sub) {
    const auto it = memory_.find(unit);
    if (it != memory_.end()) return it->second;
    return hashCombine(use.resource + 1, hashCombine(sub, std::get<2>(unit)));
  }

  std::uint64_t see(const FlatUse& use) {
    std::uint64_t symbol = 17;
    std::uint64_t previous = 0;
    std::uint32_t lastSub = kNone;
    eachUnit(use, [&](const Unit& unit, std::uint32_t sub) {
      const std::uint64_t loaded = load(unit, use, sub);
      if (sub == lastSub && loaded == previous) return;  // a buffer of several units holds one symbol
      symbol = hashCombine(symbol, loaded);
      previous = loaded;
      lastSub = sub;
    });
    return symbol;
  }

  void clear(const FlatUse& use) {
    eachUnit(use, [&](const Unit& unit, std::uint32_t sub) {
      memory_[unit] = hashCombine(use.resource * 131u + 7, sub);
    });
  }

  void runPass(std::uint32_t p) {
    const FlatPass& pass = graph_.passes[p];
    std::uint64_t inputs = hashCombine(p, 3);
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u) {
      const FlatUse& use = graph_.uses[u];
      // What stays attached for its own sake (a depth test) is seen by the whole pass.
      if (use.access == Access::read || (use.access == Access::modify && use.keep))
        inputs = hashCombine(inputs, see(use));
    }
    std::vector<std::pair<Unit, std::uint64_t>> writes;
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u) {
      const FlatUse& use = graph_.uses[u];
      if (use.access == Access::read || !runs(u)) continue;
      eachUnit(use, [&](const Unit& unit, std::uint32_t sub) {
        std::uint64_t symbol = hashCombine(inputs, hashCombine(u, sub));
        if (use.access == Access::modify) symbol = hashCombine(symbol, load(unit, use, sub));
        writes.emplace_back(unit, symbol);
      });
    }
    for (const auto& [unit, symbol] : writes) memory_[unit] = symbol;
    if (pass.sideEffect) seen_[p] = hashCombine(seen_[p], inputs);
  }

  void show() {
    const auto add = [&](const FlatUse& use) { shown_.symbols.push_back(see(use)); };
    if (graph_.present.resource != kNone && plan_.firstStep[graph_.present.resource] != kNone)
      add(graph_.present);
    for (std::size_t i = 0; i < graph_.outputs.size(); ++i)
      if (plan_.outputLive[i] != 0) add(graph_.outputs[i]);
  }

  const Plan& plan_;
  const FlatGraph& graph_;
  const bool planned_;
  std::size_t frame_ = 0;
  std::map<Unit, std::uint64_t> memory_;
  std::map<std::uint32_t, std::uint64_t> seen_;  // per pass with a side effect, over all frames
  Shown shown_;
};

}  // namespace

Shown showDeclared(const Plan& plan, std::size_t frames) {
  return Machine(plan, false).run(frames);
}
Shown showPlanned(const Plan& plan, std::size_t frames) {
  return Machine(plan, true).run(frames);
}

}  // namespace weft::graph::replay
