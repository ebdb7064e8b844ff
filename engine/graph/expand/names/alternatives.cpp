// Links lists of alternatives to what they name, and reports those that lead back to themselves or lead on in
// too long a row. Walks without recursion; everything that follows the lists later goes down the stack, so
// the length is limited here. Declared in scope.h.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/graph/expand/names/limits.h"
#include "engine/graph/expand/names/scope.h"

namespace weft::graph::expansion {

namespace {

class ListWalk {
 public:
  explicit ListWalk(Model& model) : model_(model), heights_(model.entities.size(), 0) {}

  void from(std::uint32_t start) {
    enter(start);
    while (!open_.empty()) {
      auto& [index, next] = open_.back();
      const std::vector<std::uint32_t>& candidates = model_.entities[index].candidates;
      if (next == candidates.size()) {
        leave(index);
        open_.pop_back();
        continue;
      }
      const std::uint32_t candidate = candidates[next++];
      if (candidate != kNone) enter(candidate);
    }
  }

 private:
  std::string labelOf(const Entity& entity) const { return "'" + entity.name + "'"; }

  void enter(std::uint32_t index) {
    Entity& entity = model_.entities[index];
    if (entity.kind != ResourceDesc::Kind::alternatives || entity.listState == Progress::done ||
        entity.listState == Progress::failed)
      return;
    const std::string label = labelOf(entity);
    if (entity.listState == Progress::active) {
      auto& d = reportCycle(
          model_, entity.desc->place,
          fmt::format("the alternatives of {} lead back to it: {}", label, cyclePath(model_, label)));
      d.resource = entity.name;
      return fail(entity);
    }
    entity.listState = Progress::active;
    model_.evaluating.push_back(label);
    open_.push_back({index, 0});
  }

  void leave(std::uint32_t index) {
    Entity& entity = model_.entities[index];
    model_.evaluating.pop_back();
    std::uint64_t below = 0;
    for (const std::uint32_t candidate : entity.candidates)
      if (candidate != kNone && candidate < heights_.size()) below = std::max(below, heights_[candidate]);
    heights_[index] = below + 1;
    if (entity.listState != Progress::active) return;
    entity.listState = Progress::done;
    if (heights_[index] <= base::limitOf(Limit::alternatives_depth)) return;
    if (!std::exchange(tooLong_, true)) {
      auto& d = base::reportLimit(
          model_.diagnostics, Limit::alternatives_depth, entity.desc->place,
          fmt::format("the alternatives of {} lead to alternatives in too long a row", labelOf(entity)));
      d.resource = entity.name;
    }
    fail(entity);
  }

  // Nothing follows it any more.
  void fail(Entity& entity) {
    entity.listState = Progress::failed;
    entity.candidates.assign(entity.candidates.size(), kNone);
    model_.incomplete = true;
  }

  Model& model_;
  std::vector<std::uint64_t> heights_;                       // lists in a row, this one the first
  std::vector<std::pair<std::uint32_t, std::size_t>> open_;  // and the next candidate of each
  bool tooLong_ = false;
};

void findCandidates(Model& model) {
  for (std::size_t i = 0; i < model.entities.size(); ++i) {
    Entity& entity = model.entities[i];
    if (entity.kind != ResourceDesc::Kind::alternatives) continue;
    for (const RefDesc& ref : entity.desc->alternatives) {
      if (isOver(model)) return;
      markStructural(model, *entity.scope, ref);
      entity.candidates.push_back(findEntityOrReport(model, *entity.scope, ref.name, ref.import, ref.place,
                                                     {"resource '{}' lists the", entity.name}));
    }
  }
}

}  // namespace

void linkAlternatives(Model& model) {
  findCandidates(model);
  ListWalk walk(model);
  for (std::uint32_t i = 0; i < model.entities.size(); ++i) walk.from(i);
}

}  // namespace weft::graph::expansion
