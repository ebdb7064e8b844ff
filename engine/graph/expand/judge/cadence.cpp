#include "engine/graph/expand/judge/cadence.h"

#include <fmt/format.h>

#include <set>
#include <vector>

#include "engine/graph/versions/live.h"

namespace weft::graph::expansion {

namespace {

// Why the cadence of a pass does not fit one of its reads.
enum class Mistiming : std::uint8_t { none, history, ownHistory, everyFrame, changingImport };

struct MistimedRead {
  Mistiming why = Mistiming::none;
  std::uint32_t writer = kNone;  // the pass that writes it in every frame
};

MistimedRead findMistiming(const FlatGraph& graph, std::uint32_t pass, std::uint32_t use) {
  const FlatUse& read = graph.uses[use];
  const bool once = graph.passes[pass].cadence == Cadence::once;
  if (const std::uint32_t import = graph.resources[read.resource].import; import != kNone)
    return {once && graph.imports[import].changing ? Mistiming::changingImport : Mistiming::none};
  if (once && read.history > 0) return {Mistiming::history};
  MistimedRead found;
  graph.links.forEachWriter(graph.links.seen[use], [&](std::uint32_t writer) {
    const std::uint32_t by = graph.links.passOf[writer];
    if (graph.passes[by].cadence == Cadence::always)
      found = {Mistiming::everyFrame, by};
    else if (by == pass && read.history > 0 && found.why == Mistiming::none)
      found = {Mistiming::ownHistory};
  });
  return found;
}

void warnOfCadence(Model& model, std::uint32_t pass, std::uint32_t use, const MistimedRead& found) {
  const FlatGraph& graph = model.graph;
  const PassSpec& spec = graph.specs[pass];
  const FlatUse& read = graph.uses[use];
  const std::string& resource = graph.resourceNames[read.resource];
  const std::string name = read.history > 0 ? fmt::format("{}@-{}", resource, read.history) : resource;
  const std::string writer = found.writer == kNone ? "" : graph.passNames[found.writer];
  const bool once = graph.passes[pass].cadence == Cadence::once;
  const std::string begin = once ? fmt::format("pass '{}' runs once, and reads '{}'", spec.name, name)
                                 : fmt::format(
                                       "pass '{}' runs in every frame, though it says \"on_change\": it "
                                       "reads '{}'",
                                       spec.name, name);
  std::string rest, hint;
  switch (found.why) {
    case Mistiming::none:
      return;
    case Mistiming::history:
      rest = ": nothing is there in the first frame but its first value";
      hint = fmt::format("leave \"update\" out of '{}' to run it in every frame, or read something else",
                         spec.declared);
      break;
    case Mistiming::ownHistory:
      rest = ", which each run of it changes";
      hint = fmt::format("leave \"update\" out of '{}', which then says what it does", spec.declared);
      break;
    case Mistiming::everyFrame:
      rest =
          once ? fmt::format(", which pass '{}' writes anew in every frame: it keeps what the first one had",
                             writer)
               : fmt::format(", which pass '{}' writes anew in each", writer);
      hint = fmt::format(
          "leave \"update\" out of '{}' if it is to follow; if '{}' always writes the same, make "
          "that \"update\": \"once\"",
          spec.declared, graph.specs[found.writer].declared);
      break;
    case Mistiming::changingImport:
      rest = ", which changes while the graph runs: it keeps what was there first";
      hint = fmt::format("make '{}' \"update\": \"on_change\"", spec.declared);
      break;
  }
  auto& d = model.diagnostics.warning(Code::cadenceMisfit, spec.place, begin + rest);
  d.pass = spec.name;
  d.resource = name;
  d.hint = std::move(hint);
}

// Which groups and resources have an `on_change` pass: `once` passes of them may run again, with it.
class Reruns {
 public:
  explicit Reruns(const FlatGraph& graph)
      : graph_(graph), groups_(graph.groupNames.size()), resources_(graph.resources.size()) {
    for (std::uint32_t p = 0; p < graph.passes.size(); ++p) {
      if (graph.passes[p].cadence != Cadence::on_change) continue;
      if (graph.passes[p].group != kNone) groups_[graph.passes[p].group] = true;
      eachWrite(p, [&](std::uint32_t resource) { resources_[resource] = true; });
    }
  }
  bool has(std::uint32_t pass) const {
    bool found = graph_.passes[pass].group != kNone && groups_[graph_.passes[pass].group];
    eachWrite(pass, [&](std::uint32_t resource) { found = found || resources_[resource]; });
    return found;
  }

 private:
  template <class F>
  void eachWrite(std::uint32_t pass, F&& f) const {
    const FlatPass& p = graph_.passes[pass];
    for (std::uint32_t u = p.firstUse; u < p.firstUse + p.useCount; ++u)
      if (graph_.uses[u].access != Access::read) f(graph_.uses[u].resource);
  }

  const FlatGraph& graph_;
  std::vector<bool> groups_, resources_;
};

}  // namespace

void warnCadence(Model& model) {
  const FlatGraph& graph = model.graph;
  struct Suspect {
    std::uint32_t pass, use;
    MistimedRead found;
  };
  std::vector<Suspect> suspects;
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) {
    const FlatPass& pass = graph.passes[p];
    if (pass.cadence == Cadence::always) continue;
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u) {
      if (graph.uses[u].access != Access::read) continue;
      const MistimedRead found = findMistiming(graph, p, u);
      if (found.why == Mistiming::none) continue;
      suspects.push_back({p, u, found});
      break;
    }
  }
  if (suspects.empty()) return;
  const Liveness live = findLive(graph);
  const Reruns reruns(graph);
  std::set<std::string_view> said;  // stanzas
  for (const Suspect& suspect : suspects) {
    if (live.pass[suspect.pass] == 0) continue;
    if (graph.passes[suspect.pass].cadence == Cadence::once && reruns.has(suspect.pass)) continue;
    if (said.insert(graph.specs[suspect.pass].declared).second)
      warnOfCadence(model, suspect.pass, suspect.use, suspect.found);
  }
}

}  // namespace weft::graph::expansion
