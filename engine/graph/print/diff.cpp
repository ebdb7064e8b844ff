// What changes from one plan to another. Declared in print.h.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/graph/print/explain.h"
#include "engine/graph/print/print.h"
#include "engine/text/printable.h"

namespace weft::graph {

namespace {

// Something that a plan has or lacks, under a name.
struct Fact {
  std::string name, text;
  bool there = true;
};
using Facts = std::vector<Fact>;

// A line for each fact that only one of the plans has, and where they differ.
void compareFacts(const Facts& before, const Facts& after, std::string& text) {
  const Fact none{"", "none", false};
  const auto line = [&](const std::string& name, const Fact& was, const Fact& now) {
    if ((!was.there && !now.there) || (was.there == now.there && was.text == now.text)) return;
    text += text::printable(fmt::format("{} {}: {} before, now {}",
                                        !was.there   ? '+'
                                        : !now.there ? '-'
                                                     : '~',
                                        name, was.text, now.text)) +
            "\n";
  };
  std::unordered_map<std::string_view, const Fact*> now;
  for (const Fact& fact : after) now.emplace(fact.name, &fact);
  for (const Fact& was : before) {
    const auto found = now.find(was.name);
    line(was.name, was, found == now.end() ? none : *found->second);
    if (found != now.end()) now.erase(found);
  }
  for (const Fact& fact : after)
    if (now.contains(fact.name)) line(fact.name, none, fact);
}

// The passes that both plans run, without those that moved: a longest row of them that both have in one order.
std::set<std::string_view> findKept(const Plan& before, const Plan& after) {
  std::unordered_map<std::string_view, std::uint32_t> stepBefore;
  for (std::uint32_t i = 0; i < before.steps.size(); ++i)
    stepBefore[before.graph->passNames[before.steps[i].pass]] = i;
  const auto nameAt = [&](std::uint32_t step) -> std::string_view {
    return after.graph->passNames[after.steps[step].pass];
  };
  std::vector<std::uint32_t> tail, tailAt, previous(after.steps.size(), kNone);  // by length of the row
  for (std::uint32_t i = 0; i < after.steps.size(); ++i) {
    const auto found = stepBefore.find(nameAt(i));
    if (found == stepBefore.end()) continue;
    const auto at = static_cast<std::size_t>(std::ranges::lower_bound(tail, found->second) - tail.begin());
    tail.resize(std::max(tail.size(), at + 1));
    tailAt.resize(tail.size());
    tail[at] = found->second;
    tailAt[at] = i;
    if (at > 0) previous[i] = tailAt[at - 1];
  }
  std::set<std::string_view> kept;
  for (std::uint32_t i = tailAt.empty() ? kNone : tailAt.back(); i != kNone; i = previous[i])
    kept.insert(nameAt(i));
  return kept;
}

// The steps of the passes that are not `kept`, and why other passes are no steps.
Facts passFacts(const Plan& plan, const std::set<std::string_view>& kept) {
  const FlatGraph& graph = *plan.graph;
  Facts facts;
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) {
    const std::uint32_t step = plan.stepOf[p];
    if (!kept.contains(graph.passNames[p]))
      facts.push_back({"pass " + graph.passNames[p], step == kNone ? "culled" : fmt::format("step {}", step),
                       step != kNone});
  }
  for (const DisabledPass& disabled : graph.disabled)
    facts.push_back({"pass " + disabled.name, "disabled, " + disabled.why, false});
  return facts;
}

Facts barrierFacts(const Plan& plan) {
  Facts facts;
  const auto add = [&](std::string where, std::uint16_t mask) {
    facts.push_back({std::move(where), barrierText(mask), mask != 0});
  };
  for (const Step& step : plan.steps) {
    const std::string& name = plan.graph->passNames[step.pass];
    add("barrier before " + name, step.barriers);
    add("barrier behind the clears of " + name, step.barriersAfterClears);
  }
  add("barrier at the end of the frame", plan.finalBarriers);
  return facts;
}

Facts resourceFacts(const Plan& plan) {
  Facts facts;
  for (std::uint32_t r = 0; r < plan.graph->resources.size(); ++r) {
    std::string shape = shapeText(plan.graph->resources[r]);
    if (plan.copiesOf(r) > 1) shape += fmt::format(", {} copies", plan.copiesOf(r));
    facts.push_back({"resource " + plan.graph->resourceNames[r], shape, plan.firstStep[r] != kNone});
  }
  facts.push_back({"textures", fmt::to_string(plan.storages.size())});
  for (const auto& [what, bytes] : {std::pair{"declared", plan.bytesDeclared},
                                    {"allocated", plan.bytesAllocated},
                                    {"of transient buffers", plan.arenaBytes},
                                    {"bound", plan.bytesBound}})
    facts.push_back({fmt::format("bytes {}", what), fmt::to_string(bytes)});
  return facts;
}

}  // namespace

std::string diffText(const Plan& before, const Plan& after) {
  const std::set<std::string_view> kept = findKept(before, after);
  std::string text;
  compareFacts(passFacts(before, kept), passFacts(after, kept), text);
  compareFacts(barrierFacts(before), barrierFacts(after), text);
  compareFacts(resourceFacts(before), resourceFacts(after), text);
  return text;
}

}  // namespace weft::graph
