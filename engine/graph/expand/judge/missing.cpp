// Reports reads of resources that no pass has written. Declared in judge.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "engine/graph/expand/judge/judge.h"
#include "engine/graph/expand/names/names.h"
#include "engine/graph/versions/versions.h"
#include "graph_sentences.h"

namespace weft::graph::expansion {

namespace {

constexpr const char* kMayBeEmpty =
    "end the reference with '?' if the shader can do without, or read a resource that is a list of "
    "alternatives";

bool touches(const Model& model, const WriteRecord& write, const MissingRead::Wanted& wanted) {
  if (write.entity != wanted.entity || wanted.element < write.firstElement ||
      wanted.element >= write.firstElement + write.elementCount)
    return false;
  return holds(write.use, subresourceAt(wanted.subresource, model.entities[wanted.entity].shape));
}

std::string rangeText(const EmptyRepeat& empty) {
  return fmt::format("\"{}\": [{}, {}{}]", empty.index, empty.first, empty.last,
                     empty.step == 1 ? "" : fmt::format(", {}", empty.step));
}
std::string rangeHint(const EmptyRepeat& empty) {
  return fmt::format("a range counts {}: \"{}\": [{}, {}{}]",
                     empty.step > 0 ? "down with a step" : "up without a negative step", empty.index,
                     empty.first, empty.last, empty.step > 0 ? ", -1" : "");
}

// Who would write what a read misses.
struct Writers {
  const WriteRecord* disabledEarlier = nullptr;
  const WriteRecord* enabledLater = nullptr;
  const WriteRecord* disabledLater = nullptr;
  const WriteRecord* self = nullptr;
  const RemovedPass* removed = nullptr;  // a pass that an overlay took out
  const EmptyRepeat* empty = nullptr;    // a pass that does not repeat even once
  bool selfElsewhere = false;            // the pass of the read writes another part
};

using Records = std::map<std::uint32_t, std::vector<const WriteRecord*>>;  // by entity
using PassLists = std::map<std::uint32_t, std::vector<std::uint32_t>>;     // by pass

Writers findWriters(const Model& model, const Records& all, const MissingRead& missing) {
  Writers writers;
  for (const MissingRead::Wanted& wanted : missing.wanted) {
    const Entity& entity = model.entities[wanted.entity];
    if (entity.emptied != kNone && !writers.empty) writers.empty = &model.emptied[entity.emptied];
    if (entity.desc && !writers.removed)
      for (const RemovedPass& removed : entity.scope->desc->removed)
        if (std::ranges::find(removed.writes, entity.desc->name) != removed.writes.end())
          writers.removed = &removed;
    const auto records = all.find(wanted.entity);
    if (records == all.end()) continue;
    for (const WriteRecord* write : records->second) {
      const bool own = write->pass != kNone && write->pass == missing.pass;
      writers.selfElsewhere |= own && &wanted == &missing.wanted.front();
      if (!touches(model, *write, wanted)) continue;
      const bool disabled = write->disabled != kNone;
      if (own)
        writers.self = write;
      else if (disabled && write->position < missing.position)
        writers.disabledEarlier =
            write->passesOn && writers.disabledEarlier ? writers.disabledEarlier : write;
      else if (disabled && !writers.disabledLater)
        writers.disabledLater = write;
      else if (write->pass != kNone && write->position > missing.position && !writers.enabledLater &&
               !write->passesOn)
        writers.enabledLater = write;
    }
  }
  return writers;
}

// "a -> b -> a" when `last`, which would write what `first` reads, depends on `first`; else "". `wouldRead`: of passes, what
// passes below them would give them.
std::string cycleOf(const FlatGraph& graph, const PassLists& wouldRead, std::uint32_t first,
                    std::uint32_t last) {
  const std::vector<std::uint32_t> next = findWays(graph, last, [&](std::uint32_t pass, auto&& follow) {
    graph.forEachSource(pass, [&](std::uint32_t use, std::uint32_t before) {
      if (graph.uses[use].history == 0) follow(before);
    });
    if (const auto would = wouldRead.find(pass); would != wouldRead.end())
      std::ranges::for_each(would->second, follow);
  });
  if (next[first] == kNone) return {};
  std::string path;
  for (std::uint32_t pass = first; pass != last; pass = next[pass]) path += graph.passNames[pass] + " -> ";
  return fmt::format("{}{} -> {}", path, graph.passNames[last], graph.passNames[first]);
}

// ---- what is said of one read: "pass 'x' reads 'y'", a tail, and fixes ----

std::string whoReads(const Model& model, const MissingRead& missing) {
  if (missing.pass != kNone) return fmt::format("pass '{}'", model.graph.passNames[missing.pass]);
  return missing.slot == "present" ? "present" : fmt::format("output '{}'", missing.slot);
}

const char* verbOf(const MissingRead& missing) {
  if (missing.pass == kNone) return missing.slot == "present" ? "shows" : "reads";
  return verbOf(missing.access);
}

std::string thingOf(const Model& model, const MissingRead& missing) {
  if (missing.wanted.empty()) return fmt::format("'{}'", missing.ref.text);
  const MissingRead::Wanted& wanted = missing.wanted.front();
  const Entity& entity = model.entities[wanted.entity];
  const std::string part = subresourceText(entity.shape, wanted.subresource);
  const std::string text = fmt::format("{}'{}{}'", part.empty() ? "" : part + " of ", entity.name,
                                       entity.arrayCount > 0 ? fmt::format("[{}]", wanted.element) : "");
  return missing.wanted.size() == 1
             ? text
             : fmt::format("'{}' ({} and its other alternatives)", missing.ref.text, text);
}

const std::string& resourceOf(const Model& model, const MissingRead& missing) {
  return missing.wanted.empty() ? missing.ref.name : model.entities[missing.wanted.front().entity].name;
}

struct Cause {
  text::Diagnostic said;                   // its message: a tail
  const DisabledPass* disabled = nullptr;  // that would have written it
  bool unwritten = false;                  // no pass would: what it is depends on the read alone
  const MissingRead* read = nullptr;
};
template <class... Args>
Cause because(text::Saying<Args...> what, Args&&... args) {
  return {text::diagnosticOf(what.sentence, fmt::make_format_args(args...))};
}

// `cycle`: see cycleOf().
Cause causeOf(const Model& model, const MissingRead& missing, const Writers& writers,
              const std::string& cycle) {
  const FlatGraph& graph = model.graph;
  // What is cleared alone is nothing to read back.
  const std::string orElse = missing.pass == kNone && missing.slot != "present"
                                 ? "end the reference with '?' to leave the output out when nothing writes it"
                                 : fmt::format("give '{}' a \"clear\"", resourceOf(model, missing));
  // What was there in the frame before. A first value has no earlier publication: nothing comes before it.
  const std::string orBefore =
      missing.first ? "name another texture or buffer as \"first\""
                    : fmt::format("read '{}@-1' for what it was in the frame before", missing.ref.name);
  const auto ofDisabled = [&](const WriteRecord& write) {
    const DisabledPass& disabled = graph.disabled[write.disabled];
    const bool reads = missing.pass != kNone && missing.access == Access::read;
    Cause cause = because(say::writerDisabled, disabled.name, disabled.why,
                          reads ? fmt::format("{}, or ", kMayBeEmpty) : "", orElse);
    cause.disabled = &disabled;
    return cause;
  };
  const bool modifies = missing.access == Access::modify;
  if (!missing.unbound.empty()) return because(say::readOfUnbound, missing.unbound, kMayBeEmpty);
  if (missing.cause == MissingRead::Cause::condition)
    return because(say::conditionIsFalse, missing.slot, kMayBeEmpty);
  if (missing.cause == MissingRead::Cause::import) return because(say::importHasNothing, kMayBeEmpty);
  if (const RemovedPass* removed = writers.removed) {
    const Place& place = removed->place;
    return because(
        say::writerRemoved, removed->name, resourceOf(model, missing), orElse,
        place.file ? fmt::format("\"remove\" at {}:{}:{}", *place.file, place.line, place.column) : "");
  }
  if (writers.disabledEarlier) return ofDisabled(*writers.disabledEarlier);
  if (const EmptyRepeat* empty = writers.empty)
    return because(say::writerNeverRepeats, empty->pass, rangeHint(*empty), orElse, rangeText(*empty));
  if (writers.enabledLater && missing.pass != kNone) {
    if (!cycle.empty()) return because(say::passCycle, cycle, orBefore);
    const PassSpec& later = graph.specs[writers.enabledLater->pass];
    return because(say::writtenLater, later.name, later.declared, modifies ? orElse : orBefore);
  }
  // A pass reads what it writes itself, and neither is a whole resource: there is no earlier version of it.
  if (writers.self && !writers.self->whole && missing.access == Access::read)
    return because(say::readsOwnWrite, missing.ref.name, orBefore);
  if (writers.disabledLater && !writers.self) return ofDisabled(*writers.disabledLater);
  Cause cause;
  if (missing.pass == kNone && missing.slot == "present")
    cause = because(say::presentsUnwritten);
  else if (modifies && graph.specs[missing.pass].geometry.empty())  // a draw covers a part
    cause = because(say::modifiesUnwritten, orElse);
  else if (modifies || writers.selfElsewhere)
    cause = because(say::readsUnwritten, orElse, orBefore);
  else
    cause = because(say::nobodyWrites, orElse);
  cause.unwritten = true;
  return cause;
}

// However many passes read it, one that writes it is missing: said at the first that lives, as an error; as a warning where all are culled.
void report(Model& model, const Liveness& live, const std::vector<Cause>& reads) {
  const FlatGraph& graph = model.graph;
  const auto isLive = [&](const Cause& each) {
    return each.read->pass == kNone || live.pass[each.read->pass] != 0;
  };
  const auto found = std::ranges::find_if(reads, isLive);
  Cause cause = found == reads.end() ? reads.front() : *found;
  const MissingRead& first = *cause.read;
  std::set<std::string> readers, passes;
  for (const Cause& each : reads) {
    if (isLive(each) != isLive(cause)) continue;
    const std::uint32_t pass = each.read->pass;
    readers.insert(pass == kNone ? whoReads(model, *each.read) : graph.specs[pass].declared);
    if (pass != kNone) passes.insert(graph.specs[pass].declared);
  }
  const std::string more =
      readers.size() < 2
          ? verbOf(first)
          : fmt::format("and {} more read", readers.size() == 2 ? "one" : fmt::to_string(readers.size() - 1));
  text::Diagnostic& said = cause.said;
  if (cause.disabled) {
    // Without what writes the presented texture there would be no picture.
    const std::uint32_t shown = graph.present.resource;
    const auto remains = [&](const WriteRecord& write) {
      return write.entity == model.elementOf[shown].entity && write.pass != kNone &&
             !passes.contains(graph.specs[write.pass].declared);
    };
    if (!passes.empty() && passes.size() <= 4 &&
        (shown == kNone || std::ranges::any_of(model.writes, remains)))
      said.hint.insert(0, fmt::format("disable '{}' too, or ", fmt::join(passes, "' and '")));
    const auto isSwitch = [&](const Disable& each) { return sourceOf(each) == cause.disabled->why; };
    if (!cause.disabled->absent && std::ranges::none_of(model.settings.disables, isSwitch))
      said.hint.insert(0, fmt::format("enable '{}', or ", cause.disabled->name));
  }
  said.message = fmt::format("{} {} {}{}", whoReads(model, first), more, thingOf(model, first), said.message);
  if (said.found.empty()) said.found = first.ref.text;
  said.resource = resourceOf(model, first);
  if (first.pass != kNone) said.pass = graph.passNames[first.pass];
  model.diagnostics.add(isLive(cause) ? text::Severity::error : text::Severity::warning, std::move(said),
                        first.ref.place);
}

}  // namespace

void reportMissingReads(Model& model) {
  if (model.missing.empty() && std::ranges::none_of(model.emptied, &EmptyRepeat::mistake)) return;
  constexpr int kMaxSearches = 64;
  const Liveness live = findLive(model.graph);
  Records records;
  for (const WriteRecord& write : model.writes) records[write.entity].push_back(&write);
  std::vector<Writers> writers;
  PassLists wouldRead;
  for (const MissingRead& missing : model.missing) {
    writers.push_back(findWriters(model, records, missing));
    if (missing.pass != kNone && writers.back().enabledLater)
      wouldRead[missing.pass].push_back(writers.back().enabledLater->pass);
  }
  // Reads that miss the same thing for the same reason are one mistake.
  std::vector<std::vector<Cause>> mistakes;
  std::map<std::pair<std::string, std::string>, std::size_t> known;
  std::set<std::string> emptied;
  int searches = 0;
  for (std::size_t i = 0; i < writers.size(); ++i) {
    const MissingRead& missing = model.missing[i];
    if (std::ranges::any_of(missing.wanted,
                            [&](const auto& each) { return model.leftOut.contains(each.entity); }))
      continue;  // its writer has other mistakes
    std::string cycle;
    if (missing.pass != kNone && writers[i].enabledLater && ++searches <= kMaxSearches)
      cycle = cycleOf(model.graph, wouldRead, missing.pass, writers[i].enabledLater->pass);
    Cause cause = causeOf(model, missing, writers[i], cycle);
    cause.read = &missing;
    if (cause.said.code == Code::disabledWriter && writers[i].empty) emptied.insert(writers[i].empty->pass);
    const auto at = known
                        .try_emplace({thingOf(model, missing), cause.unwritten ? "" : cause.said.message},
                                     mistakes.size())
                        .first;
    if (at->second == mistakes.size()) mistakes.emplace_back();
    mistakes[at->second].push_back(std::move(cause));
  }
  for (const std::vector<Cause>& reads : mistakes)
    if (!isOver(model)) report(model, live, reads);
  // Nobody needs what it would write, and yet nobody writes a range to have nothing.
  for (const EmptyRepeat& empty : model.emptied) {
    if (!empty.mistake || isOver(model) || !emptied.insert(empty.pass).second) continue;
    warn(model, say::emptyRepeat, empty.place, empty.pass, rangeText(empty), rangeHint(empty));
  }
}

}  // namespace weft::graph::expansion
