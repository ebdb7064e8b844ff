// Warnings about enabled passes that do not reach the picture, and slots that stay empty because their writer stands below.
// Declared in judge.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "engine/graph/expand/judge/judge.h"
#include "engine/graph/subresource.h"
#include "engine/graph/versions/live.h"
#include "engine/graph/versions/version_walk.h"

namespace weft::graph::expansion {

namespace {

// A graph in which each texture, buffer and element of an array is one resource, whatever versions it has.
class Ground {
 public:
  explicit Ground(const Model& model)
      : first_(model.entities.size(), kNone), ofResource_(model.graph.resources.size(), kNone) {
    for (std::size_t i = 0; i < model.entities.size(); ++i) {
      const Entity& entity = model.entities[i];
      const bool own =
          entity.kind == ResourceDesc::Kind::texture || entity.kind == ResourceDesc::Kind::buffer;
      if (!own || entity.state != Progress::done) continue;
      first_[i] = static_cast<std::uint32_t>(resources_.size());
      resources_.resize(resources_.size() + entity.elements.size(), entity.shape);
    }
    for (std::size_t r = 0; r < ofResource_.size(); ++r) {
      const auto [entity, element] = model.elementOf[r];
      if (first_[entity] != kNone) ofResource_[r] = first_[entity] + element;
    }
  }

  // The resource of a FlatResource of the graph; kNone for imports.
  std::uint32_t of(std::uint32_t resource) const { return ofResource_[resource]; }
  // Calls f(use) for what `what`, a WriteRecord or a WouldUse, has of each element.
  template <class What, class F>
  void eachElement(const What& what, F&& f) const {
    if (what.entity == kNone || first_[what.entity] == kNone) return;
    FlatUse use = what.rect;
    for (std::uint32_t e = what.firstElement; e < what.firstElement + what.elementCount; ++e) {
      use.resource = first_[what.entity] + e;
      f(use);
    }
  }
  const std::vector<FlatResource>& resources() const { return resources_; }

 private:
  std::vector<FlatResource> resources_;
  std::vector<std::uint32_t> first_, ofResource_;  // per entity; per FlatResource
};

// A use at a position, in the resources of a Ground.
struct Line {
  std::uint32_t position = 0;
  FlatUse use;
  std::uint32_t who = kNone;
};

// As findLive() of the graph, but everything that is disabled or whose condition is false is there, too: a disabled pass
// writes without removing what was there before. Without `histories`, what only later frames read is not alive.
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

// For each of `queries` the `who` of the mark that stands nearest before it (behind it when `behind`), at another position,
// and shares a sub-resource with it; else kNone.
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

// A read of an element that found no version but zero, in an enabled pass.
struct Missed {
  const WouldUse* would = nullptr;
  Line line;  // who: the pass
};

std::vector<Missed> findMissedReads(const Model& model, const Ground& ground) {
  std::vector<Missed> missed;
  for (const WouldUse& would : model.would) {
    if (would.why == WouldUse::Why::off || would.slot == kNone) continue;
    const auto at = std::ranges::lower_bound(model.positionOf, would.position);
    if (at == model.positionOf.end() || *at != would.position) continue;  // of a disabled pass
    const auto pass = static_cast<std::uint32_t>(at - model.positionOf.begin());
    ground.eachElement(would, [&](const FlatUse& use) {
      missed.push_back({&would, {would.position, use, pass}});
    });
  }
  return missed;
}

Line lineOf(const Model& model, const Ground& ground, std::uint32_t pass, std::uint32_t use) {
  Line line{model.positionOf[pass], model.graph.uses[use], pass};
  line.use.resource = ground.of(line.use.resource);
  return line;
}

// The entries of the file in which both stand, "post.bloom" and "post.display" of "post.bloom.up" and
// "post.display.composite": what a person moves.
std::pair<std::string, std::string> entriesOf(const std::string& a, const std::string& b) {
  std::size_t from = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()) && a[i] == b[i]; ++i)
    if (a[i] == '.') from = i + 1;
  return {a.substr(0, a.find('.', from)), b.substr(0, b.find('.', from))};
}

// In order of what a message says before the others.
enum class Reason : std::uint8_t { overwritten, readerAbove, unread, writesNothing };

// What one message is about.
struct Loss {
  Reason reason = Reason::writesNothing;
  std::uint32_t by = kNone;    // the pass that overwrites it, or the reader above
  std::uint32_t pass = kNone;  // the first that is lost
  std::uint32_t use = kNone;   // of it: what is lost
  std::vector<std::uint32_t> others{};
};

class CullReport {
 public:
  CullReport(Model& model, const Ground& ground)
      : model_(model), graph_(model.graph), ground_(ground), live_(findLive(graph_)), reach_(live_) {
    const bool all = std::ranges::find(live_.pass, 0) == live_.pass.end() &&
                     std::ranges::find(live_.use, 0) == live_.use.end();
    if (!all) reach_ = findReach(model, ground, true);
    now_ = graph_.histories.empty() ? reach_ : findReach(model, ground, false);
    anyLoss_ = !all || !graph_.histories.empty();
  }

  const Liveness& live() const { return live_; }
  bool isLost(std::uint32_t pass) const { return live_.pass[pass] == 0 && reach_.pass[pass] == 0; }

  void warn() {
    if (!anyLoss_) return;
    findLostUses();
    findFeeders();
    // A pass that no other lost pass reads is the cause of its own loss. What is left then waits for itself, by a history.
    lossOfPass_.assign(graph_.passes.size(), kNone);
    const auto count = static_cast<std::uint32_t>(graph_.passes.size());
    for (std::uint32_t p = 0; p < count; ++p)
      if (isLost(p) && !feeds_[p]) spread(p, add(lossOf(p)));
    for (std::uint32_t p = count; p-- > 0;)
      if (isLost(p) && lossOfPass_[p] == kNone) spread(p, add(lossOf(p)));
    for (const std::uint32_t use : lostUses_) addUse(use);
    for (std::uint32_t p = 0; p < count; ++p)
      if (lossOfPass_[p] != kNone) losses_[lossOfPass_[p]].others.push_back(p);
    for (const Loss& loss : losses_) report(loss);
  }

 private:
  bool runs(const Loss& loss) const { return live_.pass[loss.pass] != 0; }
  // A write that nobody sees, or only later frames.
  bool isUnseen(std::uint32_t use) const { return live_.use[use] == 0 && reach_.use[use] == 0; }
  bool isLate(std::uint32_t use) const { return live_.use[use] != 0 && now_.use[use] == 0; }

  // Such writes, with the passes that overwrite them and the readers above them.
  void findLostUses() {
    std::vector<Line> queries, overwriters, readers;
    lostAt_.assign(graph_.uses.size(), kNone);
    for (std::uint32_t p = 0; p < graph_.passes.size(); ++p) {
      std::set<std::uint32_t> seen;  // entities of which the pass writes something that somebody sees
      const auto entityOf = [&](std::uint32_t u) { return model_.elementOf[graph_.uses[u].resource].entity; };
      for (const std::uint32_t u : graph_.usesOf(p))
        if (graph_.uses[u].access != Access::read && !isUnseen(u) && !isLate(u)) seen.insert(entityOf(u));
      for (const std::uint32_t u : graph_.usesOf(p)) {
        const FlatUse& use = graph_.uses[u];
        if (ground_.of(use.resource) == kNone) continue;
        const Line line = lineOf(model_, ground_, p, u);
        if (use.access == Access::write) overwriters.push_back(line);
        if (use.access == Access::read && live_.pass[p] != 0 && now_.pass[p] != 0 && use.history == 0)
          readers.push_back(line);
        // An element of an array of which others are seen is no loss.
        if (use.access == Access::read || (!isUnseen(u) && !isLate(u)) || seen.contains(entityOf(u)))
          continue;
        lostAt_[u] = static_cast<std::uint32_t>(queries.size());
        queries.push_back(line);
        if (!isLost(p)) lostUses_.push_back(u);
      }
    }
    for (const Missed& missed : findMissedReads(model_, ground_))
      if (live_.pass[missed.line.who] != 0) readers.push_back(missed.line);
    overwriter_ = findNearest(ground_, queries, overwriters, true);
    reader_ = findNearest(ground_, queries, readers, false);
  }

  // Which passes that do not run each such pass reads from.
  void findFeeders() {
    feeders_.resize(graph_.passes.size());
    feeds_.assign(graph_.passes.size(), false);
    for (std::uint32_t p = 0; p < graph_.passes.size(); ++p) {
      if (live_.pass[p] != 0) continue;
      for (const std::uint32_t u : graph_.usesOf(p))
        graph_.links.forEachWriter(graph_.links.seen[u], [&](std::uint32_t writer) {
          const std::uint32_t feeder = graph_.links.passOf[writer];
          if (feeder == p || live_.pass[feeder] != 0) return;
          feeders_[p].push_back(feeder);
          feeds_[feeder] = true;
        });
    }
  }

  Loss lossOf(std::uint32_t pass) const {
    Loss loss{.pass = pass};
    const auto take = [&](Reason reason, std::uint32_t by, std::uint32_t use) {
      if (reason < loss.reason) loss = {reason, by, pass, use};
    };
    for (const std::uint32_t u : graph_.usesOf(pass)) {
      const std::uint32_t at = lostAt_[u];
      if (at == kNone) continue;
      if (overwriter_[at] != kNone) take(Reason::overwritten, overwriter_[at], u);
      if (reader_[at] != kNone) take(Reason::readerAbove, reader_[at], u);
      take(Reason::unread, kNone, u);
    }
    return loss;
  }

  // Several losses by one pass are one mistake; so are those of one stanza.
  std::uint32_t add(const Loss& loss) {
    const std::string& stanza = graph_.specs[loss.by == kNone ? loss.pass : loss.by].declared;
    const auto [at, fresh] =
        known_.try_emplace({loss.reason, stanza}, static_cast<std::uint32_t>(losses_.size()));
    if (fresh) losses_.push_back(loss);
    return at->second;
  }

  // What only feeds a lost pass is lost with it.
  void spread(std::uint32_t root, std::uint32_t loss) {
    std::vector<std::uint32_t> open{root};
    lossOfPass_[root] = loss;
    while (!open.empty()) {
      const std::uint32_t pass = open.back();
      open.pop_back();
      for (const std::uint32_t feeder : feeders_[pass])
        if (lossOfPass_[feeder] == kNone) {
          lossOfPass_[feeder] = loss;
          open.push_back(feeder);
        }
    }
  }

  // Of a pass that runs, or would, for something else: what nobody reads is then no mistake.
  void addUse(std::uint32_t use) {
    const std::uint32_t pass = graph_.links.passOf[use];
    const Loss loss = lossOf(pass);
    const bool late = loss.use != kNone && isLate(loss.use);
    const bool isMistake =
        late ? loss.reason == Reason::readerAbove
             : loss.reason == Reason::overwritten || (loss.reason == Reason::readerAbove && !runs(loss));
    if (!isMistake || lossOfPass_[pass] != kNone) return;
    const std::uint32_t at = add(loss);
    if (runs(loss))
      lossOfPass_[pass] = at;
    else
      spread(pass, at);
  }

  void report(const Loss& loss) {
    const PassSpec& spec = graph_.specs[loss.pass];
    std::string resource, message, hint;
    if (loss.use != kNone)
      resource = model_.entities[model_.elementOf[graph_.uses[loss.use].resource].entity].name;
    const std::string by = loss.by == kNone ? "" : graph_.passNames[loss.by];
    const auto [lost, other] =
        entriesOf(spec.declared, loss.by == kNone ? "" : graph_.specs[loss.by].declared);
    switch (loss.reason) {
      case Reason::overwritten:
        message =
            runs(loss)
                ? fmt::format(
                      "what pass '{}' writes to '{}' is lost: '{}' overwrites it before anybody reads it",
                      spec.name, resource, by)
                : fmt::format("pass '{}' is culled: '{}' overwrites '{}' before anybody reads it", spec.name,
                              by, resource);
        hint = graph_.uses[loss.use].access == Access::modify
                   ? fmt::format("move '{}' above '{}', or read '{}' in between", other, lost, resource)
                   : fmt::format("read '{}' in '{}', or use \"modify\" there, or disable '{}'", resource, by,
                                 spec.declared);
        break;
      case Reason::readerAbove:
        message = runs(loss) ? fmt::format(
                                   "only later frames see what pass '{}' writes to '{}': '{}', which reads "
                                   "it, stands above it",
                                   spec.name, resource, by)
                             : fmt::format("pass '{}' is culled: '{}', which reads '{}', stands above it",
                                           spec.name, by, resource);
        hint = fmt::format("move '{}' above '{}', or disable '{}'", lost, other, spec.declared);
        break;
      case Reason::unread:
        message = fmt::format("pass '{}' is culled: nobody reads what it writes", spec.name);
        hint = fmt::format("read '{}' in a later pass, or disable '{}'", resource, spec.declared);
        break;
      case Reason::writesNothing:
        message = fmt::format("pass '{}' is culled: it writes nothing", spec.name);
        hint = "say \"side_effect\": true if it is meant to run all the same";
        break;
    }
    std::vector<std::string_view> others;
    for (const std::uint32_t pass : loss.others)
      if (const std::string& name = graph_.specs[pass].declared;
          name != spec.declared && std::ranges::find(others, name) == others.end())
        others.push_back(name);
    if (!others.empty()) message += fmt::format("; with it: '{}'", fmt::join(others, "', '"));
    auto& d = model_.diagnostics.warning(
        loss.reason == Reason::overwritten ? Code::culledOverwritten : Code::culledUnread, spec.place,
        std::move(message));
    d.pass = spec.name;
    d.resource = resource;
    d.hint = std::move(hint);
  }

  Model& model_;
  FlatGraph& graph_;
  const Ground& ground_;
  Liveness live_, reach_, now_;  // now_: what reaches the picture of its own frame
  bool anyLoss_ = false;
  std::vector<std::uint32_t> lostUses_;              // writes of passes that run
  std::vector<std::uint32_t> lostAt_;                // per use: into the next two
  std::vector<std::uint32_t> overwriter_, reader_;   // passes
  std::vector<std::vector<std::uint32_t>> feeders_;  // per pass
  std::vector<bool> feeds_;                          // per pass: a lost pass reads what it writes
  std::vector<std::uint32_t> lossOfPass_;            // per pass: into losses_
  std::vector<Loss> losses_;
  std::map<std::pair<Reason, std::string_view>, std::uint32_t> known_;
};

// The passes whose results go, directly or through others, into what a pass makes; itself among them.
std::vector<bool> findNeeded(const FlatGraph& graph, std::uint32_t pass) {
  std::vector<bool> needed(graph.passes.size(), false);
  std::vector<std::uint32_t> open{pass};
  needed[pass] = true;
  while (!open.empty()) {
    const std::uint32_t next = open.back();
    open.pop_back();
    for (const std::uint32_t u : graph.usesOf(next)) {
      // What is drawn over needs nothing of what is there.
      if (graph.uses[u].access == Access::modify && !isStore(graph.uses[u])) continue;
      graph.links.forEachWriter(graph.links.seen[u], [&](std::uint32_t writer) {
        const std::uint32_t before = graph.links.passOf[writer];
        if (!needed[before]) open.push_back(before);
        needed[before] = true;
      });
    }
  }
  return needed;
}

// The stanzas of an entry of the file that are culled without being lost, with what only feeds them.
std::vector<std::string_view> findCulled(const FlatGraph& graph, const CullReport& report,
                                         const std::string& entry) {
  const Liveness& live = report.live();
  std::vector<bool> culled(graph.passes.size(), false);
  std::vector<std::string_view> names;
  for (auto p = static_cast<std::uint32_t>(culled.size()); p-- > 0;) {
    const std::string& name = graph.specs[p].declared;
    if (live.pass[p] != 0 || report.isLost(p)) continue;
    if (!culled[p] && name != entry && !name.starts_with(entry + ".")) continue;
    if (std::ranges::find(names, name) == names.end()) names.insert(names.begin(), name);
    for (const std::uint32_t u : graph.usesOf(p))
      graph.links.forEachWriter(graph.links.seen[u],
                                [&](std::uint32_t writer) { culled[graph.links.passOf[writer]] = true; });
  }
  return names;
}

// Not where the writer below is lost (it is told with its reader) or is another repeat of the same stanza, where a pass
// above that would write it is switched off, or where the writer needs what the reader makes and the reader only begins
// with what "clear" says.
void warnMisplaced(Model& model, const Ground& ground, const CullReport& report) {
  const FlatGraph& graph = model.graph;
  const std::vector<Missed> missed = findMissedReads(model, ground);
  if (missed.empty()) return;
  std::vector<Line> queries, marks, off;
  for (const Missed& each : missed) queries.push_back(each.line);
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
    for (const std::uint32_t u : graph.usesOf(p))
      if (!report.isLost(p) && graph.uses[u].access != Access::read &&
          ground.of(graph.uses[u].resource) != kNone)
        marks.push_back(lineOf(model, ground, p, u));
  const auto addOff = [&](const auto& what) {
    ground.eachElement(what, [&](const FlatUse& use) { off.push_back({what.position, use, 0}); });
  };
  for (const WriteRecord& write : model.writes)
    if (write.pass == kNone) addOff(write);
  for (const WouldUse& would : model.would)
    if (would.rect.access != Access::read) addOff(would);
  const std::vector<std::uint32_t> writers = findNearest(ground, queries, marks, true);
  const std::vector<std::uint32_t> switchedOff = findNearest(ground, queries, off, false);
  // What stands on the wrong side of the same entry is one mistake.
  struct Mistake {
    std::pair<std::string, std::string> entries;  // of reader and writer
    std::size_t first = 0;
    std::vector<std::string_view> readers{};  // stanzas
  };
  std::vector<Mistake> mistakes;
  std::map<std::uint32_t, std::vector<bool>> needed;  // by writer
  for (std::size_t i = 0; i < missed.size(); ++i) {
    const std::uint32_t writer = writers[i], reader = queries[i].who;
    if (writer == kNone || report.live().pass[reader] == 0 || switchedOff[i] != kNone) continue;
    const std::string &name = graph.specs[reader].declared, &other = graph.specs[writer].declared;
    if (name == other) continue;
    if (missed[i].would->why == WouldUse::Why::zero) {
      const auto [at, fresh] = needed.try_emplace(writer);
      if (fresh) at->second = findNeeded(graph, writer);
      if (at->second[reader]) continue;
    }
    auto entries = entriesOf(name, other);
    auto at = std::ranges::find(mistakes, entries, &Mistake::entries);
    if (at == mistakes.end()) at = mistakes.insert(at, {std::move(entries), i});
    if (std::ranges::find(at->readers, name) == at->readers.end()) at->readers.push_back(name);
  }
  for (const auto& [entries, first, readers] : mistakes) {
    const WouldUse& would = *missed[first].would;
    const PassSpec& spec = graph.specs[queries[first].who];
    const SlotSpec& slot = graph.slots[spec.firstSlot + would.slot];
    const std::string& resource = model.entities[would.entity].name;
    std::string message = fmt::format("pass '{}' reads '{}' before pass '{}' writes it: its slot '{}' {}",
                                      spec.name, resource, graph.specs[writers[first]].name, slot.name,
                                      would.why == WouldUse::Why::zero ? "has only what \"clear\" says"
                                      : slot.useCount == 0             ? "stays empty"
                                                                       : "takes another alternative");
    if (readers.size() > 1)
      message += fmt::format("; likewise '{}'", fmt::join(readers.begin() + 1, readers.end(), "', '"));
    if (const auto culled = findCulled(graph, report, entries.second); !culled.empty())
      message += fmt::format("; culled: '{}'", fmt::join(culled, "', '"));
    auto& d = model.diagnostics.warning(Code::readBeforeWrite, slot.place, std::move(message));
    d.pass = spec.name;
    d.resource = resource;
    d.hint = fmt::format("move '{}' above '{}', or read '{}@-1' for what it was in the frame before",
                         entries.second, entries.first, resource);
  }
}

}  // namespace

void warnUnread(Model& model) {
  FlatGraph& graph = model.graph;
  if (graph.present.resource == kNone && graph.outputs.empty() &&
      std::ranges::none_of(graph.passes, &FlatPass::sideEffect)) {
    auto& d = model.diagnostics.warning(Code::nothingPresented, model.desc.place,
                                        "the graph shows nothing: no pass will run");
    d.hint = "say \"present\" with the texture to show";
    return;
  }
  const Ground ground(model);
  CullReport report(model, ground);
  report.warn();
  warnMisplaced(model, ground, report);
}

}  // namespace weft::graph::expansion
