// Warnings about enabled passes that do not reach the picture, and slots that stay empty because their writer stands below.
// Declared in judge.h.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "engine/graph/expand/judge/judge.h"
#include "engine/graph/subresource.h"
#include "engine/graph/versions/versions.h"
#include "graph_sentences.h"

namespace weft::graph::expansion {

namespace {

// A read or write of a texture or buffer at a position in declared order.
struct Line : Part {
  std::uint32_t position = 0, who = kNone;
};

// Of a use of the graph.
Line lineOf(const Model& model, std::uint32_t use, std::uint32_t who) {
  const FlatUse& rect = model.graph.uses[use];
  const auto [entity, element] = model.elementOf[rect.resource];
  return {{entity, element, 1, rect}, model.positionOf[model.graph.links.passOf[use]], who};
}

bool isOwn(const Model& model, std::uint32_t entity) {
  return entity != kNone && model.entities[entity].isOwn();
}

// Calls f(write) for each WriteRecord and WouldUse that writes something, if what is switched off now were there.
template <class F>
void eachOffWrite(const Model& model, F&& f) {
  for (const WriteRecord& write : model.writes)
    if (write.pass == kNone) f(write);
  for (const WouldUse& would : model.would)
    if (would.use.access != Access::read) f(would);
}

// What is alive: `live` in the graph. `ever`, if everything that is disabled or whose condition is false were there, too: a disabled
// pass is never culled then, and removes nothing. `now`, of that, without what only later frames or culled passes read.
struct Reach {
  Liveness live, ever, now;
  bool isLost(std::uint32_t pass) const { return live.pass[pass] == 0 && ever.pass[pass] == 0; }
  // A write that only later frames see; that, or nobody sees it.
  bool isLate(std::uint32_t use) const { return live.use[use] != 0 && now.use[use] == 0; }
  bool isGone(std::uint32_t use) const { return now.use[use] == 0; }
};

Reach findReach(const Model& model) {
  const FlatGraph& graph = model.graph;
  Reach reach{.live = findLive(graph), .ever = {}, .now = {}};
  reach.ever = reach.now = reach.live;
  const bool all = std::ranges::find(reach.live.pass, 0) == reach.live.pass.end() &&
                   std::ranges::find(reach.live.use, 0) == reach.live.use.end();
  if (all && graph.histories.empty()) return reach;

  // Each texture, buffer and element of an array is one resource, whatever versions it has; each position is one pass.
  FlatGraph whole;
  std::vector<std::uint32_t> resourceOf(model.entities.size(), kNone);  // of the first element
  for (std::uint32_t i = 0; i < model.entities.size(); ++i)
    if (isOwn(model, i)) {
      resourceOf[i] = static_cast<std::uint32_t>(whole.resources.size());
      whole.resources.resize(whole.resources.size() + model.entities[i].elements.size(),
                             model.entities[i].shape);
    }
  std::vector<Line> lines;
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
    for (const std::uint32_t u : graph.usesOf(p)) lines.push_back(lineOf(model, u, u));
  std::set<std::uint32_t> effects;  // positions of what is off and has a side effect
  const auto add = [&](Line line) {
    if (line.use.keep) effects.insert(line.position);
    // It may test the depth, or read the storage, that it modifies; color it only draws over.
    line.use.keep = line.use.access == Access::modify && line.use.kind != Kind::color;
    if (line.use.access == Access::write) line.use.access = Access::modify;  // it removes nothing now
    lines.push_back(line);
  };
  eachOffWrite(model, [&](const auto& what) { add({what, what.position}); });
  for (const WouldUse& would : model.would)
    if (would.use.access == Access::read) add({would, would.position});
  // What is off now is never culled but in `now`; what is read after all passes counts.
  std::vector<std::size_t> off;
  const auto keepsOrNotes = [&](std::uint32_t position) {
    const auto at = std::ranges::lower_bound(model.positionOf, position);
    const bool on = at != model.positionOf.end() && *at == position;
    if (!on && position != kNone && !effects.contains(position)) off.push_back(whole.passes.size());
    return !on || graph.passes[static_cast<std::size_t>(at - model.positionOf.begin())].sideEffect;
  };
  std::ranges::stable_sort(lines, {}, &Line::position);
  std::vector<std::uint32_t> useOf;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Line& line = lines[i];
    if (i == 0 || line.position != lines[i - 1].position)
      whole.passes.push_back({.firstUse = static_cast<std::uint32_t>(whole.uses.size()),
                              .sideEffect = keepsOrNotes(line.position)});
    for (std::uint32_t e = 0; isOwn(model, line.entity) && e < line.elementCount; ++e) {
      whole.uses.push_back(line.use);
      whole.uses.back().resource = resourceOf[line.entity] + line.firstElement + e;
      useOf.push_back(line.who);
      ++whole.passes.back().useCount;
    }
  }
  whole.present.resource = kNone;
  const auto addFinal = [&](FlatUse use, auto&& take) {
    const auto [entity, element] = model.elementOf[use.resource];
    if (!isOwn(model, entity)) return;
    use.resource = resourceOf[entity] + element;
    take(use);
  };
  if (graph.present.resource != kNone)
    addFinal(graph.present, [&](const FlatUse& use) { whole.present = use; });
  for (const FlatUse& output : graph.outputs)
    addFinal(output, [&](const FlatUse& use) { whole.outputs.push_back(use); });
  linkVersions(whole);

  const auto spread = [&](Liveness& live) {
    const Liveness found = findLive(whole);
    live.use.assign(graph.uses.size(), 1);
    for (std::uint32_t p = 0; p < graph.passes.size(); ++p) live.pass[p] = graph.passes[p].sideEffect ? 1 : 0;
    for (std::uint32_t u = 0; u < useOf.size(); ++u)
      if (useOf[u] != kNone) {
        live.use[useOf[u]] = found.use[u];
        live.pass[graph.links.passOf[useOf[u]]] |= found.pass[whole.links.passOf[u]];
      }
  };
  if (!all) spread(reach.ever);
  for (const std::size_t pass : off) whole.passes[pass].sideEffect = false;
  for (std::uint32_t u = 0; u < useOf.size(); ++u)
    if (whole.uses[u].history > 0 && (useOf[u] != kNone || !whole.passes[whole.links.passOf[u]].sideEffect))
      whole.links.seen[u] = kNone;
  spread(reach.now);
  return reach;
}

// Lines of textures and buffers, by entity.
class Lines {
 public:
  void add(const Model& model, const Line& line) {
    if (isOwn(model, line.entity)) lines_[line.entity].push_back(line);
  }
  // The `who` of the line nearest above `at` (`below`: below), at another position, that shares a sub-resource with it; or kNone.
  std::uint32_t nearest(const Line& at, bool below) const {
    const Line* best = nullptr;
    eachAt(at, below, [&](const Line& line) {
      if (!best || (below ? line.position < best->position : line.position > best->position)) best = &line;
    });
    return best ? best->who : kNone;
  }
  // Calls f(line) for all of these.
  template <class F>
  void eachAt(const Line& at, bool below, F&& f) const {
    const auto found = lines_.find(at.entity);
    if (found == lines_.end()) return;
    for (const Line& line : found->second)
      if ((below ? line.position > at.position : line.position < at.position) && line.overlaps(at)) f(line);
  }

 private:
  std::map<std::uint32_t, std::vector<Line>> lines_;
};

// A read, or a part of one, that found no version but zero, in an enabled pass.
struct Missed {
  Line line;
  std::uint32_t slot = kNone;  // of the pass
  WouldUse::Why why = WouldUse::Why::zero;
  std::uint32_t pass = kNone;
  std::string part{};  // of what the slot reads, where that is more
};

// The levels of each layer that a read sees as "clear" left them, where it sees more than that.
void addMissedParts(const Model& model, std::uint32_t use, std::uint32_t slot, std::vector<Missed>& missed) {
  const FlatGraph& graph = model.graph;
  const FlatUse& read = graph.uses[use];
  const FlatResource& shape = graph.resources[read.resource];
  const std::uint32_t pass = graph.links.passOf[use];
  const Line whole = lineOf(model, use, pass);
  std::uint32_t next = kNone;
  forEachVersion(graph.links, graph.links.seen[use], read, shape, [&](std::uint32_t s, std::uint32_t writer) {
    if (writer != kNone) return;
    const auto [mip, layer, plane] = subresourceAt(s, shape);
    if (s == next && mip > 0) {
      ++missed.back().line.use.mips;
    } else {
      Line part = whole;
      part.use.mip = static_cast<std::uint16_t>(mip);
      part.use.layer = static_cast<std::uint16_t>(layer);
      part.use.mips = part.use.layers = 1;
      part.use.planes = static_cast<std::uint8_t>(1u << plane);
      missed.push_back({part, slot, WouldUse::Why::zero, pass, " of " + subresourceText(shape, s)});
    }
    next = s + 1;
  });
}

std::vector<Missed> findMissedReads(const Model& model) {
  const FlatGraph& graph = model.graph;
  std::vector<Missed> missed;
  for (const WouldUse& would : model.would) {
    if (would.why == WouldUse::Why::off || would.slot == kNone || !isOwn(model, would.entity)) continue;
    const auto at = std::ranges::lower_bound(model.positionOf, would.position);
    if (at == model.positionOf.end() || *at != would.position) continue;
    const auto pass = static_cast<std::uint32_t>(at - model.positionOf.begin());
    missed.push_back({{would, would.position, pass}, would.slot, would.why, pass});
  }
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
    for (std::uint32_t s = 0; s < graph.specs[p].slotCount; ++s) {
      const SlotSpec& slot = graph.slots[graph.specs[p].firstSlot + s];
      for (std::uint32_t u = slot.firstUse; u < slot.firstUse + slot.useCount; ++u)
        if (slot.access == Access::read && graph.uses[u].history == 0 &&
            VersionLinks::hasRuns(graph.links.seen[u]) &&
            isOwn(model, model.elementOf[graph.uses[u].resource].entity))
          addMissedParts(model, u, s, missed);
    }
  return missed;
}

// The entries of the file in which both stand, "post.bloom" and "post.display" of "post.bloom.up" and
// "post.display.composite": what a person moves.
std::pair<std::string, std::string> entriesOf(const std::string& a, const std::string& b) {
  std::size_t from = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()) && a[i] == b[i]; ++i)
    if (a[i] == '.') from = i + 1;
  return {a.substr(0, a.find('.', from)), b.substr(0, b.find('.', from))};
}

// Adds "; WORD 'a', 'b' and 12 more" to a message: as many names as fit.
void addNames(std::string& message, const char* word, const std::vector<std::string_view>& names) {
  constexpr std::size_t kMaxBytes = 520;
  std::size_t count = 0;
  for (; count < names.size() && message.size() + names[count].size() < kMaxBytes; ++count)
    message += fmt::format("{}'{}'", count == 0 ? fmt::format("; {} ", word) : ", ", names[count]);
  if (count < names.size())
    message += count == 0 ? fmt::format("; {} {} more", word, names.size())
                          : fmt::format(" and {} more", names.size() - count);
}

// ---- what is lost ----

// In order of what a message says before the others.
enum class Reason : std::uint8_t { overwritten, readerAbove, unread, writesNothing };

// What one message is about.
struct Loss {
  Reason reason = Reason::writesNothing;
  std::uint32_t by = kNone;    // the pass that overwrites it, or the reader above
  std::uint32_t pass = kNone;  // the first that is lost
  std::uint32_t use = kNone;   // of it: what is lost
};

// Writes that are gone, without elements of an array of which the pass writes others that are seen.
std::vector<std::uint32_t> findGone(const Model& model, const Reach& reach) {
  const FlatGraph& graph = model.graph;
  std::vector<std::uint32_t> gone;
  const auto entityOf = [&](std::uint32_t u) { return model.elementOf[graph.uses[u].resource].entity; };
  const auto isWrite = [&](std::uint32_t u) { return graph.uses[u].access != Access::read; };
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
    for (const std::uint32_t u : graph.usesOf(p))
      if (isWrite(u) && reach.isGone(u) && isOwn(model, entityOf(u)) &&
          std::ranges::none_of(graph.usesOf(p), [&](std::uint32_t other) {
            return isWrite(other) && entityOf(other) == entityOf(u) && !reach.isGone(other);
          }))
        gone.push_back(u);
  return gone;
}

// What each pass loses first.
std::map<std::uint32_t, Loss> findLosses(const Model& model, const Reach& reach,
                                         const std::vector<Missed>& missedReads) {
  const FlatGraph& graph = model.graph;
  std::map<std::uint32_t, Loss> losses;
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
    if (reach.isLost(p)) losses[p].pass = p;
  const std::vector<std::uint32_t> gone = findGone(model, reach);
  if (gone.empty()) return losses;
  Lines overwriters, readers;
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
    for (const std::uint32_t u : graph.usesOf(p)) {
      const FlatUse& use = graph.uses[u];
      if (use.access == Access::write) overwriters.add(model, lineOf(model, u, p));
      if (use.access == Access::read && use.history == 0 && reach.live.pass[p] != 0 && reach.now.pass[p] != 0)
        readers.add(model, lineOf(model, u, p));
    }
  for (const Missed& missed : missedReads)
    if (reach.live.pass[missed.pass] != 0) readers.add(model, missed.line);
  for (const std::uint32_t u : gone) {
    const std::uint32_t pass = graph.links.passOf[u];
    const Line line = lineOf(model, u, pass);
    Loss loss{Reason::overwritten, overwriters.nearest(line, true), pass, u};
    if (loss.by == kNone) loss = {Reason::readerAbove, readers.nearest(line, false), pass, u};
    if (loss.by == kNone) loss.reason = Reason::unread;
    Loss& first = losses[pass];
    if (first.pass == kNone || loss.reason < first.reason) first = loss;
  }
  return losses;
}

void report(Model& model, const Loss& loss, bool runs, const std::vector<std::string_view>& others) {
  const FlatGraph& graph = model.graph;
  const PassSpec& spec = graph.specs[loss.pass];
  // Not what makes something else besides, itself or in its other repeats.
  const std::string orDisable =
      runs || spec.name != spec.declared ? "" : fmt::format(", or disable '{}'", spec.name);
  const std::string resource =
      loss.use == kNone ? "" : model.entities[model.elementOf[graph.uses[loss.use].resource].entity].name;
  const std::string by = loss.by == kNone ? "" : graph.passNames[loss.by];
  const auto [lost, other] = entriesOf(spec.declared, loss.by == kNone ? "" : graph.specs[loss.by].declared);
  const bool overwritten = loss.reason == Reason::overwritten;
  const std::string what =
      !runs         ? fmt::format("pass '{}' is culled", spec.name)
      : overwritten ? fmt::format("what pass '{}' writes to '{}' is lost", spec.name, resource)
                    : fmt::format("only later frames see what pass '{}' writes to '{}'", spec.name, resource);
  text::Diagnostics& all = model.diagnostics;
  text::Diagnostic& said =
      overwritten
          ? all.warning(
                say::lossOverwritten, spec.place, what, by, resource,
                graph.uses[loss.use].access == Access::modify
                    ? fmt::format("move '{}' above '{}', or read '{}' in between", other, lost, resource)
                    : fmt::format("read '{}' in '{}', or use \"modify\" there{}", resource, by, orDisable))
      : loss.reason == Reason::readerAbove
          ? all.warning(say::lossReadAbove, spec.place, what, by, resource, lost, other, orDisable)
      : loss.reason == Reason::unread ? all.warning(say::lossUnread, spec.place, what, resource, orDisable)
                                      : all.warning(say::lossWritesNothing, spec.place, what);
  addNames(said.message, "with it:", others);
  said.resource = resource;
  said.pass = spec.name;
}

void warnOfLosses(Model& model, const Reach& reach, const std::vector<Missed>& missed) {
  const FlatGraph& graph = model.graph;
  const std::map<std::uint32_t, Loss> lossOf = findLosses(model, reach, missed);
  if (lossOf.empty()) return;
  const auto runs = [&](std::uint32_t pass) { return reach.live.pass[pass] != 0; };
  std::vector<Loss> losses;
  std::vector<std::uint32_t> told(graph.passes.size(), kNone);  // per pass: into losses
  // Several losses by one pass are one mistake; so are those of one stanza.
  std::map<std::pair<Reason, std::string_view>, std::uint32_t> known;
  const auto add = [&](const Loss& loss) {
    const std::string& stanza = graph.specs[loss.by == kNone ? loss.pass : loss.by].declared;
    const auto [at, fresh] =
        known.try_emplace({loss.reason, stanza}, static_cast<std::uint32_t>(losses.size()));
    if (fresh) losses.push_back(loss);
    return at->second;
  };
  // What only feeds a lost pass is lost with it.
  const auto spread = [&](const Loss& loss) {
    const std::uint32_t at = add(loss);
    const auto with = findWays(graph, loss.pass, [&](std::uint32_t pass, auto&& follow) {
      graph.forEachSource(pass, [&](std::uint32_t, std::uint32_t feeder) {
        if (!runs(loss.pass) && !runs(feeder) && told[feeder] == kNone) follow(feeder);
      });
    });
    for (std::size_t p = 0; p < with.size(); ++p)
      if (with[p] != kNone) told[p] = at;
  };
  std::vector<bool> feeds(graph.passes.size(), false);
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
    graph.forEachSource(p, [&](std::uint32_t, std::uint32_t feeder) {
      if (feeder != p && !runs(feeder) && !runs(p)) feeds[feeder] = true;
    });
  // A pass that no other lost pass reads is the cause of its own loss. What is left then waits for itself, by a history.
  for (const auto& [p, loss] : lossOf)
    if (reach.isLost(p) && !feeds[p]) spread(loss);
  for (auto at = lossOf.rbegin(); at != lossOf.rend(); ++at)
    if (reach.isLost(at->first) && told[at->first] == kNone) spread(at->second);
  // Of a pass that runs, or would, for something else, what nobody reads is no mistake.
  for (const auto& [p, loss] : lossOf) {
    if (told[p] != kNone || reach.isLost(p)) continue;
    const bool above = loss.reason == Reason::readerAbove;
    if (reach.isLate(loss.use) ? above : loss.reason == Reason::overwritten || (above && !runs(p)))
      spread(loss);
  }
  std::vector<std::vector<std::string_view>> others(losses.size());  // stanzas
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) {
    if (told[p] == kNone) continue;
    const std::string& name = graph.specs[p].declared;
    std::vector<std::string_view>& with = others[told[p]];
    if (name != graph.specs[losses[told[p]].pass].declared && std::ranges::find(with, name) == with.end())
      with.push_back(name);
  }
  for (std::size_t i = 0; i < losses.size(); ++i) report(model, losses[i], runs(losses[i].pass), others[i]);
}

// ---- what stands on the wrong side ----

// The stanzas of an entry of the file, and of `writers`, that are culled without being lost, with what only feeds them.
std::vector<std::string_view> findCulled(const FlatGraph& graph, const Reach& reach, const std::string& entry,
                                         const std::set<std::uint32_t>& writers) {
  std::vector<bool> culled(graph.passes.size(), false);
  for (const std::uint32_t writer : writers) culled[writer] = true;
  std::vector<std::string_view> names;
  for (auto p = static_cast<std::uint32_t>(culled.size()); p-- > 0;) {
    const std::string& name = graph.specs[p].declared;
    if (reach.live.pass[p] != 0 || reach.isLost(p)) continue;
    if (!culled[p] && name != entry && !name.starts_with(entry + ".")) continue;
    if (std::ranges::find(names, name) == names.end()) names.insert(names.begin(), name);
    graph.forEachSource(p, [&](std::uint32_t, std::uint32_t feeder) { culled[feeder] = true; });
  }
  return names;
}

// Not where the writer below is lost (it is told with its reader) or is another repeat of the same stanza, where a pass
// above that would write it is switched off, or where the writer runs, needs what the reader makes, and the reader begins
// a chain with another alternative or what "clear" says.
void warnMisplaced(Model& model, const Reach& reach, const std::vector<Missed>& missed) {
  const FlatGraph& graph = model.graph;
  if (missed.empty()) return;
  Lines writers, off;
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
    for (const std::uint32_t u : graph.usesOf(p))
      if (!reach.isLost(p) && graph.uses[u].access != Access::read) writers.add(model, lineOf(model, u, p));
  eachOffWrite(model, [&](const auto& what) { off.add(model, {what, what.position, 0}); });
  // What stands on the wrong side of the same entry is one mistake.
  struct Mistake {
    std::pair<std::string, std::string> entries;  // of reader and writer
    Missed missed;
    std::uint32_t writer = kNone;
    std::vector<std::string_view> others{};  // stanzas that read it, too
    std::set<std::uint32_t> below{};         // passes that write it
  };
  std::vector<Mistake> mistakes;
  for (const Missed& miss : missed) {
    const std::uint32_t reader = miss.pass, writer = writers.nearest(miss.line, true);
    if (writer == kNone || reach.live.pass[reader] == 0 || off.nearest(miss.line, false) != kNone) continue;
    const std::string &name = graph.specs[reader].declared, &other = graph.specs[writer].declared;
    const bool begins = graph.slots[graph.specs[reader].firstSlot + miss.slot].useCount > 0;
    // What is drawn over needs nothing of what is there.
    const auto sources = [&](std::uint32_t pass, auto&& follow) {
      graph.forEachSource(pass, [&](std::uint32_t use, std::uint32_t source) {
        if (graph.uses[use].access != Access::modify || isStore(graph.uses[use])) follow(source);
      });
    };
    if (name == other ||
        (begins && reach.live.pass[writer] != 0 && findWays(graph, writer, sources)[reader] != kNone))
      continue;
    auto entries = entriesOf(name, other);
    auto at = std::ranges::find(mistakes, entries, &Mistake::entries);
    if (at == mistakes.end())
      at = mistakes.insert(at, {std::move(entries), miss, writer});
    else if (name != graph.specs[at->missed.pass].declared &&
             std::ranges::find(at->others, name) == at->others.end())
      at->others.push_back(name);
    writers.eachAt(miss.line, true, [&](const Line& line) { at->below.insert(line.who); });
  }
  for (const auto& [entries, miss, writer, others, below] : mistakes) {
    const auto& [line, slotOfPass, why, reader, part] = miss;
    const PassSpec& spec = graph.specs[reader];
    const SlotSpec& slot = graph.slots[spec.firstSlot + slotOfPass];
    const std::string& resource = model.entities[line.entity].name;
    text::Diagnostic& said = model.diagnostics.warning(
        say::readsBeforeWrite, slot.place, spec.name, resource, graph.specs[writer].name, slot.name,
        why == WouldUse::Why::zero ? "has only what \"clear\" says"
        : slot.useCount == 0       ? "stays empty"
                                   : "takes another alternative",
        part, entries.second, entries.first);
    addNames(said.message, "likewise", others);
    addNames(said.message, "culled:", findCulled(graph, reach, entries.second, below));
  }
}

}  // namespace

void warnUnread(Model& model) {
  FlatGraph& graph = model.graph;
  if (graph.present.resource == kNone && graph.outputs.empty() &&
      std::ranges::none_of(graph.passes, &FlatPass::sideEffect)) {
    return warn(model, say::showsNothing, model.desc.place);
  }
  const Reach reach = findReach(model);
  const std::vector<Missed> missed = findMissedReads(model);
  warnOfLosses(model, reach, missed);
  warnMisplaced(model, reach, missed);
}

}  // namespace weft::graph::expansion
