#include "engine/graph/print/diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/base/printable.h"
#include "engine/graph/print/explain.h"

namespace weft::graph {

namespace {

const std::string& nameAt(const Plan& plan, std::uint32_t step) {
  return plan.graph->passNames[plan.steps[step].pass];
}

class Differ {
 public:
  Differ(const Plan& before, const Plan& after) : before_(before), after_(after) {
    for (std::uint32_t i = 0; i < before.steps.size(); ++i) stepBefore_[nameAt(before, i)] = i;
    for (std::uint32_t i = 0; i < after.steps.size(); ++i) stepAfter_[nameAt(after, i)] = i;
  }

  std::string run() {
    tellPasses();
    tellBarriers();
    tellResources();
    tellBytes();
    return std::move(text_);
  }

 private:
  void line(const std::string& text) { text_ += base::printable(text) + "\n"; }

  // Why a step of one plan is no step of the other.
  static std::string fateIn(const Plan& plan, const std::string& name) {
    const FlatGraph& graph = *plan.graph;
    for (const DisabledPass& disabled : graph.disabled)
      if (disabled.name == name) return fmt::format("disabled, {}", disabled.why);
    const bool culled = std::ranges::find(graph.passNames, name) != graph.passNames.end();
    return culled ? "culled" : "not in the graph";
  }

  // The passes of both that keep their order: a longest ascending row of their steps in `before`. All others moved.
  std::vector<std::uint8_t> findKept() const {
    const std::size_t count = after_.steps.size();
    std::vector<std::uint32_t> tail, tailAt, previous(count, kNone);  // by length of the row
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto found = stepBefore_.find(nameAt(after_, i));
      if (found == stepBefore_.end()) continue;
      const auto at = static_cast<std::size_t>(std::ranges::lower_bound(tail, found->second) - tail.begin());
      if (at == tail.size()) {
        tail.push_back(0);
        tailAt.push_back(0);
      }
      tail[at] = found->second;
      tailAt[at] = i;
      previous[i] = at > 0 ? tailAt[at - 1] : kNone;
    }
    std::vector<std::uint8_t> kept(count, 0);
    for (std::uint32_t i = tailAt.empty() ? kNone : tailAt.back(); i != kNone; i = previous[i]) kept[i] = 1;
    return kept;
  }

  void tellPasses() {
    for (std::uint32_t i = 0; i < before_.steps.size(); ++i)
      if (const std::string& name = nameAt(before_, i); !stepAfter_.contains(name))
        line(fmt::format("- pass {}: step {} before, now {}", name, i, fateIn(after_, name)));
    const std::vector<std::uint8_t> kept = findKept();
    for (std::uint32_t i = 0; i < after_.steps.size(); ++i) {
      const std::string& name = nameAt(after_, i);
      const auto old = stepBefore_.find(name);
      if (old == stepBefore_.end())
        line(fmt::format("+ pass {}: step {}, {} before", name, i, fateIn(before_, name)));
      else if (kept[i] == 0)
        line(fmt::format("~ pass {}: step {} before, now {}", name, old->second, i));
    }
  }

  void tellMask(const std::string& where, std::uint16_t before, std::uint16_t after) {
    const auto added = static_cast<std::uint16_t>(after & ~before),
               gone = static_cast<std::uint16_t>(before & ~after);
    if (gone != 0) line(fmt::format("- barrier {}: {}", where, barrierText(gone)));
    if (added != 0) line(fmt::format("+ barrier {}: {}", where, barrierText(added)));
  }

  void tellBarriers() {
    for (std::uint32_t i = 0; i < before_.steps.size(); ++i)
      if (const std::string& name = nameAt(before_, i); !stepAfter_.contains(name))
        tellMask("before " + name, before_.steps[i].barriers | before_.steps[i].barriersAfterClears, 0);
    for (std::uint32_t i = 0; i < after_.steps.size(); ++i) {
      const std::string& name = nameAt(after_, i);
      const auto old = stepBefore_.find(name);
      const Step none{};
      const Step& was = old == stepBefore_.end() ? none : before_.steps[old->second];
      tellMask("before " + name, was.barriers, after_.steps[i].barriers);
      tellMask("behind the clears of " + name, was.barriersAfterClears, after_.steps[i].barriersAfterClears);
    }
    tellMask("at the end of the frame", before_.finalBarriers, after_.finalBarriers);
  }

  static std::string shapeOf(const Plan& plan, std::uint32_t r) {
    const FlatResource& resource = plan.graph->resources[r];
    if (plan.firstStep[r] == kNone) return "not used";
    if (resource.kind == ResourceKind::buffer || resource.kind == ResourceKind::imported_buffer)
      return fmt::format("buffer of {} bytes", resource.bytes);
    return fmt::format("{} {}x{}x{}, {} layers, {} levels, {} samples", infoOf(resource.format).name,
                       resource.width, resource.height, resource.depth, resource.layers, resource.mips,
                       resource.samples) +
           (plan.copiesOf(r) > 1 ? fmt::format(", {} copies", plan.copiesOf(r)) : "");
  }

  void tellResources() {
    std::unordered_map<std::string_view, std::uint32_t> old;
    for (std::uint32_t r = 0; r < before_.graph->resources.size(); ++r)
      old[before_.graph->resourceNames[r]] = r;
    for (std::uint32_t r = 0; r < after_.graph->resources.size(); ++r) {
      const std::string& name = after_.graph->resourceNames[r];
      const std::string now = shapeOf(after_, r);
      const auto found = old.find(name);
      const std::string was = found == old.end() ? "not used" : shapeOf(before_, found->second);
      if (found != old.end()) old.erase(found);
      if (was != now) line(fmt::format("~ resource {}: {} before, now {}", name, was, now));
    }
    for (std::uint32_t r = 0; r < before_.graph->resources.size(); ++r)
      if (old.contains(before_.graph->resourceNames[r]) && before_.firstStep[r] != kNone)
        line(fmt::format("- resource {}: {} before", before_.graph->resourceNames[r], shapeOf(before_, r)));
  }

  void tellBytes() {
    const auto tell = [&](const char* what, std::uint64_t was, std::uint64_t now) {
      if (was != now)
        line(fmt::format("~ bytes {}: {} before, now {} ({}{})", what, was, now, now > was ? "+" : "-",
                         now > was ? now - was : was - now));
    };
    if (before_.storages.size() != after_.storages.size())
      line(fmt::format("~ textures: {} before, now {}", before_.storages.size(), after_.storages.size()));
    tell("declared", before_.bytesDeclared, after_.bytesDeclared);
    tell("allocated", before_.bytesAllocated, after_.bytesAllocated);
    tell("of transient buffers", before_.arenaBytes, after_.arenaBytes);
    tell("bound", before_.bytesBound, after_.bytesBound);
  }

  const Plan &before_, &after_;
  std::unordered_map<std::string_view, std::uint32_t> stepBefore_, stepAfter_;
  std::string text_;
};

}  // namespace

std::string diffText(const Plan& before, const Plan& after) {
  return Differ(before, after).run();
}

}  // namespace weft::graph
