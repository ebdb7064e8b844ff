#include "engine/graph/expand/judge/reach.h"

#include <algorithm>

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

namespace {

// The graph with everything in it, pass by pass in the order of positions.
class Whole {
 public:
  Whole(const Model& model, const Ground& ground, bool histories)
      : model_(model), graph_(model.graph), ground_(ground), histories_(histories) {
    all_.resources = ground.resources();
    at_.resize(graph_.uses.size(), kNone);
  }

  Liveness run() {
    std::size_t pass = 0, write = 0, would = 0;
    const auto positionOf = [](const auto& list, std::size_t at) {
      return at < list.size() ? list[at].position : kNone;
    };
    for (;;) {
      while (write < model_.writes.size() && model_.writes[write].pass != kNone) ++write;  // is in the graph
      const std::uint32_t own = pass < graph_.passes.size() ? model_.positionOf[pass] : kNone;
      const std::uint32_t position =
          std::min({own, positionOf(model_.writes, write), positionOf(model_.would, would)});
      FlatPass& here = all_.passes.emplace_back();
      here.firstUse = static_cast<std::uint32_t>(all_.uses.size());
      here.sideEffect = position == kNone;  // what is read after all passes counts
      if (own == position && position != kNone) {
        passes_.push_back(static_cast<std::uint32_t>(all_.passes.size() - 1));
        addPass(pass++);
      }
      for (; would < model_.would.size() && model_.would[would].position == position; ++would)
        addWould(model_.would[would]);
      for (; write < model_.writes.size() && model_.writes[write].position == position; ++write)
        if (const WriteRecord& record = model_.writes[write]; record.pass == kNone)
          addWhere(record.entity, record.firstElement, record.elementCount, record.rect);
      FlatPass& filled = all_.passes.back();
      filled.useCount = static_cast<std::uint32_t>(all_.uses.size()) - filled.firstUse;
      if (position == kNone) break;
    }
    addEnds();
    linkVersions(all_);
    const Liveness found = findLive(all_);
    Liveness live{std::vector<std::uint8_t>(graph_.passes.size()), std::vector<std::uint8_t>(at_.size())};
    for (std::size_t p = 0; p < passes_.size(); ++p) live.pass[p] = found.pass[passes_[p]];
    for (std::size_t u = 0; u < at_.size(); ++u) live.use[u] = at_[u] == kNone ? 1 : found.use[at_[u]];
    return live;
  }

 private:
  void addPass(std::size_t pass) {
    const FlatPass& flat = graph_.passes[pass];
    all_.passes.back().sideEffect = flat.sideEffect;
    for (std::uint32_t u = flat.firstUse; u < flat.firstUse + flat.useCount; ++u) {
      FlatUse use = graph_.uses[u];
      use.resource = ground_.of(use.resource);
      if (use.resource == kNone || (use.history > 0 && !histories_)) continue;
      at_[u] = static_cast<std::uint32_t>(all_.uses.size());
      all_.uses.push_back(use);
    }
  }

  // A write that is not there now takes nothing away.
  void addWhere(std::uint32_t entity, std::uint32_t first, std::uint32_t count, FlatUse rect) {
    // It may test the depth, or read the storage, that it modifies; color it only draws over.
    if (rect.history > 0 && !histories_) return;
    rect.keep = rect.access == Access::modify && rect.kind != Kind::color;
    if (rect.access == Access::write) rect.access = Access::modify;
    ground_.eachElement(entity, first, count, rect, [&](const FlatUse& use) { all_.uses.push_back(use); });
  }
  void addWould(const WouldUse& would) {
    if (would.entity == kNone)
      all_.passes.back().sideEffect = true;
    else
      addWhere(would.entity, would.firstElement, would.elementCount, would.rect);
  }

  void addEnds() {
    const auto translated = [&](FlatUse use) {
      if (use.resource != kNone) use.resource = ground_.of(use.resource);
      return use;
    };
    all_.present = translated(graph_.present);
    for (const FlatUse& output : graph_.outputs)
      if (const FlatUse use = translated(output); use.resource != kNone) all_.outputs.push_back(use);
  }

  const Model& model_;
  const FlatGraph& graph_;
  const Ground& ground_;
  const bool histories_;
  FlatGraph all_;
  std::vector<std::uint32_t> at_, passes_;  // of a use and a pass of the graph: the one here
};

}  // namespace

Liveness findReach(const Model& model, const Ground& ground) {
  return Whole(model, ground, true).run();
}
Liveness findReachNow(const Model& model, const Ground& ground) {
  return Whole(model, ground, false).run();
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
