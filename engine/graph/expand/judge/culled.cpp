#include "engine/graph/expand/judge/culled.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_map>

#include "engine/graph/versions/live.h"

namespace weft::graph::expansion {

namespace {

bool covers(const WriteRecord& later, const WriteRecord& earlier) {
  return later.rect.access == Access::write && later.firstElement <= earlier.firstElement &&
         earlier.firstElement + earlier.elementCount <= later.firstElement + later.elementCount &&
         covers(later.rect, earlier.rect);
}

struct Fate {
  bool writes = false, intended = false;
  const WriteRecord* otherLevels = nullptr;  // what it wrote of a resource of which other levels are read
  std::uint32_t overwriter = kNone, entity = kNone;
};

// Who may read, behind the write and up to its overwriter, what it wrote.
enum class Readers : std::uint8_t { none, otherLevels, some };

Readers readersOf(const Entity& entity, const WriteRecord& write, const WriteRecord* overwriter) {
  constexpr std::ptrdiff_t kLookedAt = 64;  // of the readers of a resource; beyond, one is assumed
  const auto first = std::ranges::upper_bound(entity.mentions, write.position, {}, &Mention::position);
  Readers found = Readers::none;
  for (auto at = first; at != entity.mentions.end(); ++at) {
    if (overwriter && at->position > overwriter->position) break;
    const bool level =
        at->firstMip < std::uint32_t{write.rect.mip} + write.rect.mips && at->lastMip >= write.rect.mip;
    if (level || at - first == kLookedAt) return Readers::some;
    found = Readers::otherLevels;
  }
  return found;
}

}  // namespace

void warnUnread(Model& model) {
  FlatGraph& graph = model.graph;
  const bool effects =
      std::any_of(graph.passes.begin(), graph.passes.end(), [](const FlatPass& p) { return p.sideEffect; });
  if (graph.present.resource == kNone && !effects) {
    auto& d = model.diagnostics.warning(Code::nothingPresented, model.desc.place,
                                        "the graph shows nothing: no pass will run");
    d.hint = "say \"present\" with the texture to show";
    return;
  }
  const Liveness live = findLive(graph);
  if (std::ranges::find(live.pass, 0) == live.pass.end()) return;
  for (Entity& entity : model.entities) std::ranges::sort(entity.mentions, {}, &Mention::position);
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> byEntity;
  for (std::uint32_t i = 0; i < model.writes.size(); ++i)
    if (model.writes[i].pass != kNone) byEntity[model.writes[i].entity].push_back(i);

  std::vector<Fate> fates(graph.passes.size());
  for (const auto& [index, records] : byEntity) {
    const Entity& entity = model.entities[index];
    for (std::size_t r = 0; r < records.size(); ++r) {
      const WriteRecord& write = model.writes[records[r]];
      if (live.pass[write.pass] != 0) continue;
      Fate& fate = fates[write.pass];
      fate.writes = true;
      const WriteRecord* overwriter = nullptr;
      for (std::size_t l = r + 1; l < std::min(records.size(), r + 64) && !overwriter; ++l)
        if (const WriteRecord& later = model.writes[records[l]];
            later.position > write.position && covers(later, write))
          overwriter = &later;
      // What an included file makes is its interface: leaving some of it unused is no mistake.
      if (entity.scope->parent && !overwriter) fate.intended = true;
      if (const Readers readers = readersOf(entity, write, overwriter); readers == Readers::some)
        fate.intended = true;
      else if (readers == Readers::otherLevels)
        fate.otherLevels = &write;
      if (overwriter && (fate.overwriter == kNone || overwriter->pass < fate.overwriter))
        fate.overwriter = overwriter->pass;
      if (fate.entity == kNone || index < fate.entity) fate.entity = index;
    }
  }
  std::set<std::string_view> said, running;  // stanzas
  for (std::uint32_t pass = 0; pass < graph.passes.size(); ++pass)
    if (live.pass[pass] != 0) running.insert(graph.specs[pass].declared);
  for (std::uint32_t pass = 0; pass < graph.passes.size(); ++pass) {
    const Fate& fate = fates[pass];
    if (live.pass[pass] != 0 || fate.intended || !said.insert(graph.specs[pass].declared).second) continue;
    const PassSpec& spec = graph.specs[pass];
    // When a chain is read in part, its other levels are no mistake.
    if (fate.otherLevels && running.contains(spec.declared)) continue;
    const std::string resource = fate.entity == kNone ? "" : model.entities[fate.entity].name;
    base::Diagnostic* d = nullptr;
    if (fate.overwriter != kNone) {
      d = &model.diagnostics.warning(
          Code::culledOverwritten, spec.place,
          fmt::format("pass '{}' is culled: '{}' overwrites '{}' before anybody reads it", spec.name,
                      graph.passNames[fate.overwriter], resource));
      d->hint = fmt::format("read '{}' in '{}', or use \"modify\" there, or disable '{}'", resource,
                            graph.passNames[fate.overwriter], spec.declared);
    } else if (fate.otherLevels) {
      const FlatUse& use = fate.otherLevels->rect;
      const std::string levels = use.mips == 1
                                     ? fmt::format("level {}", use.mip)
                                     : fmt::format("levels {} to {}", use.mip, use.mip + use.mips - 1);
      d = &model.diagnostics.warning(Code::culledUnread, spec.place,
                                     fmt::format("pass '{}' is culled: nobody reads {} of '{}', only others",
                                                 spec.name, levels, resource));
      d->hint = fmt::format("read all of '{}' in a later pass, or disable '{}'", resource, spec.declared);
    } else if (fate.writes) {
      d = &model.diagnostics.warning(
          Code::culledUnread, spec.place,
          fmt::format("pass '{}' is culled: nobody reads what it writes", spec.name));
      d->hint = fmt::format("read '{}' in a later pass, or disable '{}'", resource, spec.declared);
    } else {
      d = &model.diagnostics.warning(Code::culledUnread, spec.place,
                                     fmt::format("pass '{}' is culled: it writes nothing", spec.name));
      d->hint = "say \"side_effect\": true if it is meant to run all the same";
    }
    d->pass = spec.name;
    d->resource = resource;
  }
}

}  // namespace weft::graph::expansion
