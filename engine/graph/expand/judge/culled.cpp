#include "engine/graph/expand/judge/culled.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "engine/graph/expand/judge/misplaced.h"
#include "engine/graph/expand/judge/reach.h"

namespace weft::graph::expansion {

namespace {

enum class Reason : std::uint8_t { overwritten, readerAbove, unread, writesNothing };

// What one message is about.
struct Loss {
  Reason reason = Reason::unread;
  std::uint32_t by = kNone;    // the pass that overwrites it, or the reader above
  std::uint32_t pass = kNone;  // the first that is lost
  std::uint32_t use = kNone;   // of it: what is lost
  bool runs = false;           // the pass, for something else
  std::vector<std::uint32_t> others{};
};

class Losses {
 public:
  // `now`: what reaches the picture of its own frame.
  Losses(Model& model, const Ground& ground, const Liveness& live, const Liveness& reach, const Liveness& now)
      : model_(model), graph_(model.graph), ground_(ground), live_(live), reach_(reach), now_(now) {}

  void run() {
    findLostUses();
    for (std::uint32_t p = 0; p < graph_.passes.size(); ++p)
      if (isLost(p)) lost_.push_back(p);
    findReaders();
    // One that no other such pass reads is the cause of its own loss. What is left then waits for itself, by a history.
    loss_.assign(graph_.passes.size(), kNone);
    for (const std::uint32_t p : lost_)
      if (!fed_[p]) blame(p);
    for (auto p = lost_.rbegin(); p != lost_.rend(); ++p)
      if (loss_[*p] == kNone) blame(*p);
    for (const std::uint32_t use : lostUses_) blameUse(use);
    for (std::uint32_t p = 0; p < loss_.size(); ++p)
      if (loss_[p] != kNone) losses_[loss_[p]].others.push_back(p);
    for (const Loss& loss : losses_) say(loss);
  }

  bool isLost(std::uint32_t pass) const { return live_.pass[pass] == 0 && reach_.pass[pass] == 0; }

 private:
  template <class F>
  void eachUse(std::uint32_t pass, F&& f) const {
    const FlatPass& flat = graph_.passes[pass];
    for (std::uint32_t u = flat.firstUse; u < flat.firstUse + flat.useCount; ++u) f(u);
  }

  Line lineOf(std::uint32_t pass, std::uint32_t use) const {
    Line line{model_.positionOf[pass], graph_.uses[use], pass};
    line.use.resource = ground_.of(line.use.resource);
    return line;
  }

  // Writes that nobody sees, with the pass that overwrites them and the reader above them.
  bool isUnseen(std::uint32_t use) const { return live_.use[use] == 0 && reach_.use[use] == 0; }
  // A write that only later frames see.
  bool isLate(std::uint32_t use) const {
    return graph_.uses[use].access != Access::read && live_.use[use] != 0 && now_.use[use] == 0;
  }
  void findLostUses() {
    std::vector<Line> queries, overwriters, readers;
    std::vector<std::uint32_t> seen;  // entities of which a pass writes something that somebody sees
    lostAt_.assign(graph_.uses.size(), kNone);
    const auto unseen = [&](std::uint32_t u) { return isUnseen(u) || isLate(u); };
    const auto entityOf = [&](std::uint32_t u) { return model_.elementOf[graph_.uses[u].resource].entity; };
    for (std::uint32_t p = 0; p < graph_.passes.size(); ++p) {
      seen.clear();
      eachUse(p, [&](std::uint32_t u) {
        if (graph_.uses[u].access != Access::read && !unseen(u)) seen.push_back(entityOf(u));
      });
      eachUse(p, [&](std::uint32_t u) {
        const FlatUse& use = graph_.uses[u];
        if (ground_.of(use.resource) == kNone) return;
        if (use.access == Access::write) overwriters.push_back(lineOf(p, u));
        if (use.access == Access::read && live_.pass[p] != 0 && now_.pass[p] != 0 && use.history == 0)
          readers.push_back(lineOf(p, u));
        // An element of an array of which others are seen is no loss.
        if (use.access == Access::read || !unseen(u) || std::ranges::find(seen, entityOf(u)) != seen.end())
          return;
        lostAt_[u] = static_cast<std::uint32_t>(queries.size());
        queries.push_back(lineOf(p, u));
        if (!isLost(p)) lostUses_.push_back(u);
      });
    }
    for (const Missed& missed : missedReads(model_, ground_))
      if (live_.pass[missed.line.who] != 0) readers.push_back(missed.line);
    overwriter_ = findNearest(ground_, queries, overwriters, true);
    reader_ = findNearest(ground_, queries, readers, false);
    read_.assign(ground_.resources().size(), false);
    for (const Line& reader : readers) read_[reader.use.resource] = true;
  }

  // Which passes that do not run each such pass reads from.
  void findReaders() {
    feeders_.resize(graph_.passes.size());
    fed_.assign(graph_.passes.size(), false);
    for (std::uint32_t p = 0; p < graph_.passes.size(); ++p) {
      if (live_.pass[p] != 0) continue;
      eachUse(p, [&](std::uint32_t u) {
        graph_.links.forEachWriter(graph_.links.seen[u], [&](std::uint32_t writer) {
          const std::uint32_t feeder = graph_.links.passOf[writer];
          if (feeder == p || live_.pass[feeder] != 0) return;
          feeders_[p].push_back(feeder);
          fed_[feeder] = true;
        });
      });
    }
  }

  Loss lossOf(std::uint32_t pass) const {
    Loss loss{.reason = Reason::writesNothing, .pass = pass, .runs = live_.pass[pass] != 0};
    const auto take = [&](Reason reason, std::uint32_t by, std::uint32_t use) {
      if (reason >= loss.reason) return;
      loss.reason = reason;
      loss.by = by;
      loss.use = use;
    };
    eachUse(pass, [&](std::uint32_t u) {
      const std::uint32_t at = lostAt_[u];
      if (at == kNone) return;
      if (overwriter_[at] != kNone) take(Reason::overwritten, overwriter_[at], u);
      if (reader_[at] != kNone) take(Reason::readerAbove, reader_[at], u);
      take(Reason::unread, kNone, u);
    });
    return loss;
  }

  // Several losses by one pass are one mistake; so are those of one stanza.
  std::uint32_t add(Loss loss) {
    const std::string& stanza =
        loss.by == kNone ? graph_.specs[loss.pass].declared : graph_.specs[loss.by].declared;
    const auto [at, fresh] =
        known_.try_emplace({loss.reason, stanza}, static_cast<std::uint32_t>(losses_.size()));
    if (fresh) losses_.push_back(std::move(loss));
    return at->second;
  }

  // `root` is lost, and what only feeds it is lost with it.
  void blame(std::uint32_t root) { blame(root, add(lossOf(root))); }
  void blame(std::uint32_t root, std::uint32_t loss) {
    std::vector<std::uint32_t> open{root};
    loss_[root] = loss;
    while (!open.empty()) {
      const std::uint32_t pass = open.back();
      open.pop_back();
      for (const std::uint32_t feeder : feeders_[pass]) {
        if (loss_[feeder] != kNone) continue;
        loss_[feeder] = loss;
        open.push_back(feeder);
      }
    }
  }

  // Of a pass that runs, or would, for something else: what nobody reads is then no mistake.
  void blameUse(std::uint32_t use) {
    const std::uint32_t pass = graph_.links.passOf[use];
    const Loss loss = lossOf(pass);
    const bool late = loss.use != kNone && isLate(loss.use);
    const bool told =
        late ? loss.reason == Reason::readerAbove
             : loss.reason == Reason::overwritten || (loss.reason == Reason::readerAbove && !loss.runs);
    if (!told || loss_[pass] != kNone) return;
    const std::uint32_t at = add(loss);
    if (loss.runs)
      loss_[pass] = at;
    else
      blame(pass, at);
  }

  // ", with it: 'a', 'b'"
  std::string othersOf(const Loss& loss) const {
    std::string text;
    std::set<std::string_view> said{graph_.specs[loss.pass].declared};
    for (const std::uint32_t pass : loss.others)
      if (const std::string& name = graph_.specs[pass].declared; said.insert(name).second)
        text += fmt::format("{}'{}'", text.empty() ? "; with it: " : ", ", name);
    return text;
  }

  std::string levelsOf(const FlatUse& use) const {
    return use.mips == 1 ? fmt::format("level {}", use.mip)
                         : fmt::format("levels {} to {}", use.mip, use.mip + use.mips - 1);
  }

  void say(const Loss& loss) {
    const PassSpec& spec = graph_.specs[loss.pass];
    const FlatUse* const use = loss.use == kNone ? nullptr : &graph_.uses[loss.use];
    const std::string resource =
        use ? model_.entities[model_.elementOf[use->resource].entity].name : std::string();
    std::string message, hint;
    switch (loss.reason) {
      case Reason::overwritten: {
        const std::string& by = graph_.passNames[loss.by];
        message = loss.runs ? fmt::format(
                                  "what pass '{}' writes to '{}' is lost: '{}' overwrites it before anybody "
                                  "reads it",
                                  spec.name, resource, by)
                            : fmt::format("pass '{}' is culled: '{}' overwrites '{}' before anybody reads it",
                                          spec.name, by, resource);
        const auto [lost, other] = entriesOf(spec.declared, graph_.specs[loss.by].declared);
        hint = use->access == Access::modify
                   ? fmt::format("move '{}' above '{}', or read '{}' in between", other, lost, resource)
                   : fmt::format("read '{}' in '{}', or use \"modify\" there, or disable '{}'", resource, by,
                                 spec.declared);
        break;
      }
      case Reason::readerAbove: {
        const std::string& by = graph_.passNames[loss.by];
        message = loss.runs
                      ? fmt::format(
                            "only later frames see what pass '{}' writes to '{}': '{}', which reads it, "
                            "stands above it",
                            spec.name, resource, by)
                      : fmt::format("pass '{}' is culled: '{}', which reads '{}', stands above it", spec.name,
                                    by, resource);
        const auto [lost, other] = entriesOf(spec.declared, graph_.specs[loss.by].declared);
        hint = fmt::format("move '{}' above '{}', or disable '{}'", lost, other, spec.declared);
        break;
      }
      case Reason::unread:
        message = isPart(*use) ? fmt::format("pass '{}' is culled: nobody reads {} of '{}', only others",
                                             spec.name, levelsOf(*use), resource)
                               : fmt::format("pass '{}' is culled: nobody reads what it writes", spec.name);
        hint = isPart(*use)
                   ? fmt::format("read all of '{}' in a later pass, or disable '{}'", resource, spec.declared)
                   : fmt::format("read '{}' in a later pass, or disable '{}'", resource, spec.declared);
        break;
      case Reason::writesNothing:
        message = fmt::format("pass '{}' is culled: it writes nothing", spec.name);
        hint = "say \"side_effect\": true if it is meant to run all the same";
        break;
    }
    auto& d = model_.diagnostics.warning(
        loss.reason == Reason::overwritten ? Code::culledOverwritten : Code::culledUnread, spec.place,
        message + othersOf(loss));
    d.pass = spec.name;
    d.resource = resource;
    d.hint = std::move(hint);
  }

  // Levels of a resource of which others are read.
  bool isPart(const FlatUse& use) const {
    const FlatResource& shape = graph_.resources[use.resource];
    return use.mips < shape.mips && read_[ground_.of(use.resource)];
  }

  Model& model_;
  FlatGraph& graph_;
  const Ground& ground_;
  const Liveness &live_, &reach_, &now_;
  std::vector<std::uint32_t> lost_, lostUses_;       // passes; writes of passes that run
  std::vector<std::uint32_t> lostAt_;                // per use: into the next two
  std::vector<std::uint32_t> overwriter_, reader_;   // passes
  std::vector<bool> read_;                           // per resource of the ground
  std::vector<std::vector<std::uint32_t>> feeders_;  // per pass
  std::vector<bool> fed_;                            // per pass: a lost pass reads what it writes
  std::vector<std::uint32_t> loss_;                  // per pass: into losses_
  std::vector<Loss> losses_;
  std::map<std::pair<Reason, std::string_view>, std::uint32_t> known_;
};

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
  const Liveness live = findLive(graph);
  const Ground ground(model);
  const bool all =
      std::ranges::find(live.pass, 0) == live.pass.end() && std::ranges::find(live.use, 0) == live.use.end();
  const Liveness reach = all ? live : findReach(model, ground);
  const Liveness now = graph.histories.empty() ? reach : findReachNow(model, ground);
  Losses losses(model, ground, live, reach, now);
  if (!all || !graph.histories.empty()) losses.run();
  warnMisplaced(model, ground, live, [&](std::uint32_t pass) { return losses.isLost(pass); });
}

}  // namespace weft::graph::expansion
