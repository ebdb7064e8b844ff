#include "engine/graph/expand/judge/reach.h"

#include <algorithm>
#include <map>

#include "engine/graph/subresource.h"
#include "engine/graph/versions/version_walk.h"

namespace weft::graph::expansion {

Ground::Ground(const Model& model)
    : first_(model.entities.size(), kNone), ofResource_(model.graph.resources.size(), kNone) {
  for (std::size_t i = 0; i < model.entities.size(); ++i) {
    const Entity& entity = model.entities[i];
    const bool own = entity.kind == ResourceDesc::Kind::texture || entity.kind == ResourceDesc::Kind::buffer;
    if (!own || entity.state != Progress::done) continue;
    first_[i] = static_cast<std::uint32_t>(resources_.size());
    resources_.resize(resources_.size() + entity.elements.size(), entity.shape);
  }
  for (std::size_t r = 0; r < ofResource_.size(); ++r) {
    const auto [entity, element] = model.elementOf[r];
    if (first_[entity] != kNone) ofResource_[r] = first_[entity] + element;
  }
}

Liveness findReach(const Model& model, const Ground& ground, bool histories) {
  constexpr std::uint32_t kOther = kNone;  // a use that is not in the graph
  struct Instance {
    std::uint32_t pass = kNone;  // of the graph
    bool sideEffect = false;
    std::vector<std::pair<FlatUse, std::uint32_t>> uses{};  // with their index in the graph
  };
  const FlatGraph& graph = model.graph;
  std::map<std::uint32_t, Instance> instances;  // by position
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) {
    Instance& instance = instances[model.positionOf[p]];
    instance.pass = p;
    instance.sideEffect = graph.passes[p].sideEffect;
    for (const std::uint32_t u : graph.usesOf(p)) {
      FlatUse use = graph.uses[u];
      use.resource = ground.of(use.resource);
      if (use.resource != kNone && (use.history == 0 || histories)) instance.uses.emplace_back(use, u);
    }
  }
  instances[kNone].sideEffect = true;  // what is read after all passes counts
  const auto add = [&](const auto& what) {
    if (what.rect.history > 0 && !histories) return;
    ground.eachElement(what, [&](FlatUse use) {
      // It may test the depth, or read the storage, that it modifies; color it only draws over.
      use.keep = use.access == Access::modify && use.kind != Kind::color;
      if (use.access == Access::write) use.access = Access::modify;  // what is not there now removes nothing
      instances[what.position].uses.emplace_back(use, kOther);
    });
  };
  for (const WouldUse& would : model.would) {
    if (would.entity == kNone) instances[would.position].sideEffect = true;
    add(would);
  }
  for (const WriteRecord& write : model.writes)
    if (write.pass == kNone) add(write);  // the others are in the graph

  FlatGraph all;
  all.resources = ground.resources();
  Liveness live{std::vector<std::uint8_t>(graph.passes.size()),
                std::vector<std::uint8_t>(graph.uses.size(), 1)};
  std::vector<std::uint32_t> useOf;
  for (const auto& [position, instance] : instances) {
    all.passes.push_back({.firstUse = static_cast<std::uint32_t>(all.uses.size()),
                          .useCount = static_cast<std::uint32_t>(instance.uses.size()),
                          .sideEffect = instance.sideEffect});
    for (const auto& [use, index] : instance.uses) {
      all.uses.push_back(use);
      useOf.push_back(index);
    }
  }
  const auto grounded = [&](FlatUse use) {
    if (use.resource != kNone) use.resource = ground.of(use.resource);
    return use;
  };
  all.present = grounded(graph.present);
  for (const FlatUse& output : graph.outputs)
    if (const FlatUse use = grounded(output); use.resource != kNone) all.outputs.push_back(use);
  linkVersions(all);
  const Liveness found = findLive(all);
  std::uint32_t at = 0;
  for (const auto& [position, instance] : instances) {
    if (instance.pass != kNone) live.pass[instance.pass] = found.pass[at];
    ++at;
  }
  for (std::size_t u = 0; u < useOf.size(); ++u)
    if (useOf[u] != kOther) live.use[useOf[u]] = found.use[u];
  return live;
}

std::vector<std::uint32_t> findNearest(const Ground& ground, const std::vector<Line>& queries,
                                       const std::vector<Line>& marks, bool behind) {
  struct Stop {
    std::uint32_t position, index;
    bool mark;
  };
  std::vector<Stop> stops;
  for (std::uint32_t i = 0; i < queries.size(); ++i) stops.push_back({queries[i].position, i, false});
  for (std::uint32_t i = 0; i < marks.size(); ++i) stops.push_back({marks[i].position, i, true});
  std::ranges::sort(stops, [&](const Stop& a, const Stop& b) {
    if (a.position != b.position) return behind ? a.position > b.position : a.position < b.position;
    return a.mark != b.mark ? b.mark : a.index < b.index;  // a mark is not near to its own position
  });
  // Marks write, queries read: then a query sees its mark.
  FlatGraph line;
  line.resources = ground.resources();
  for (const Stop& stop : stops) {
    FlatUse use = (stop.mark ? marks : queries)[stop.index].use;
    use.access = stop.mark ? Access::write : Access::read;
    use.history = 0;
    line.passes.push_back({.firstUse = static_cast<std::uint32_t>(line.uses.size()), .useCount = 1});
    line.uses.push_back(use);
  }
  line.present.resource = kNone;
  linkVersions(line);
  std::vector<std::uint32_t> found(queries.size(), kNone);
  for (std::uint32_t i = 0; i < stops.size(); ++i)
    if (!stops[i].mark)
      line.links.forEachWriter(line.links.seen[i], [&](std::uint32_t mark) {
        std::uint32_t& who = found[stops[i].index];
        if (who == kNone) who = marks[stops[mark].index].who;
      });
  return found;
}

}  // namespace weft::graph::expansion
