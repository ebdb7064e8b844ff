// Reports reads of resources that no pass has written. Declared in judge.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "engine/graph/expand/judge/judge.h"
#include "engine/graph/expand/names/names.h"
#include "engine/graph/versions/live.h"

namespace weft::graph::expansion {

namespace {

constexpr const char* kMayBeEmpty =
    "end the reference with '?' if the shader can do without, or read a resource that is a list of "
    "alternatives";

bool touches(const Model& model, const WriteRecord& write, const MissingRead::Wanted& wanted) {
  if (write.entity != wanted.entity || wanted.element < write.firstElement ||
      wanted.element >= write.firstElement + write.elementCount)
    return false;
  return holds(write.rect, subresourceAt(wanted.subresource, model.entities[wanted.entity].shape));
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
};

// Reads that miss the same thing for the same reason: a pass is disabled or removed, or there is none.
struct MissedThing {
  std::string thing;
  const DisabledPass* disabled = nullptr;
  const RemovedPass* removed = nullptr;
  std::vector<const MissingRead*> reads{};
};

class MissingReadReporter {
 public:
  explicit MissingReadReporter(Model& model)
      : model_(model), graph_(model.graph), live_(findLive(model.graph)) {}

  void run() {
    for (const WriteRecord& write : model_.writes) byEntity_[write.entity].push_back(&write);
    std::vector<Writers> writers;
    for (const MissingRead& missing : model_.missing) {
      writers.push_back(findWriters(missing));
      if (missing.pass != kNone && writers.back().enabledLater)
        wouldRead_[missing.pass].push_back(writers.back().enabledLater->pass);
    }
    for (std::size_t i = 0; i < writers.size() && !isOver(model_); ++i) judge(model_.missing[i], writers[i]);
    for (const MissedThing& missed : missed_)
      if (!isOver(model_)) report(missed);
    for (const EmptyRepeat& empty : model_.emptied)
      if (empty.mistake && !isOver(model_) && reportedRepeats_.insert(empty.pass).second) warnOfEmpty(empty);
  }

 private:
  Writers findWriters(const MissingRead& missing) const {
    Writers writers;
    for (const MissingRead::Wanted& wanted : missing.wanted) {
      const Entity& entity = model_.entities[wanted.entity];
      if (entity.emptied != kNone && !writers.empty) writers.empty = &model_.emptied[entity.emptied];
      if (entity.desc && !writers.removed)
        for (const RemovedPass& removed : entity.scope->desc->removed)
          if (std::ranges::find(removed.writes, entity.desc->name) != removed.writes.end())
            writers.removed = &removed;
      const auto records = byEntity_.find(wanted.entity);
      if (records == byEntity_.end()) continue;
      for (const WriteRecord* write : records->second) {
        if (!touches(model_, *write, wanted)) continue;
        const bool disabled = write->disabled != kNone;
        if (write->pass != kNone && write->pass == missing.pass)
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

  std::string who(const MissingRead& missing) const {
    if (missing.pass != kNone) return fmt::format("pass '{}'", graph_.passNames[missing.pass]);
    return missing.slot == "present" ? "present" : fmt::format("output '{}'", missing.slot);
  }
  static const char* verb(const MissingRead& missing) {
    if (missing.pass == kNone) return missing.slot == "present" ? "shows" : "reads";
    return missing.access == Access::modify ? "modifies" : "reads";
  }
  std::string what(const MissingRead& missing) const {
    if (missing.wanted.empty()) return fmt::format("'{}'", missing.ref.text);
    const MissingRead::Wanted& wanted = missing.wanted.front();
    const Entity& entity = model_.entities[wanted.entity];
    const std::string part = subresourceText(entity.shape, wanted.subresource);
    const std::string text = fmt::format("{}'{}{}'", part.empty() ? "" : part + " of ", entity.name,
                                         entity.arrayCount > 0 ? fmt::format("[{}]", wanted.element) : "");
    return missing.wanted.size() == 1
               ? text
               : fmt::format("'{}' ({} and its other alternatives)", missing.ref.text, text);
  }
  const std::string& resourceOf(const MissingRead& missing) const {
    return missing.wanted.empty() ? missing.ref.name : model_.entities[missing.wanted.front().entity].name;
  }
  bool isLive(const MissingRead& missing) const {
    return missing.pass == kNone || live_.pass[missing.pass] != 0;
  }
  std::string orClear(const MissingRead& missing) const {
    return fmt::format("give '{}' a \"clear\"", resourceOf(missing));
  }
  // What was there in the frame before. A first value has no earlier publication: nothing comes before it.
  static std::string orBefore(const MissingRead& missing) {
    return missing.first ? "name another texture or buffer as \"first\""
                         : fmt::format("read '{}@-1' for what it was in the frame before", missing.ref.name);
  }

  // An error in a live pass, a warning in a culled one; the repeats of a stanza say it once.
  void report(const MissingRead& missing, Code code, std::string message,
              const std::vector<std::string>& fixes, const std::string& found = "") {
    const Place& place = missing.ref.place;
    const bool live = isLive(missing);
    const std::string key =
        fmt::format("{} {} {} {} {}", static_cast<int>(code), place.line, place.column, live,
                    missing.pass == kNone ? missing.slot : graph_.specs[missing.pass].declared);
    if (!reported_.insert(key).second) return;
    text::Diagnostic d;
    d.severity = live ? text::Severity::error : text::Severity::warning;
    d.code = code;
    d.message = std::move(message);
    d.place = place;
    if (missing.pass != kNone) d.pass = graph_.passNames[missing.pass];
    d.resource = resourceOf(missing);
    d.found = found.empty() ? missing.ref.text : found;
    d.hint = fmt::format("{}", fmt::join(fixes, ", or "));
    model_.diagnostics.add(std::move(d));
  }

  void judge(const MissingRead& missing, const Writers& writers) {
    const std::string thing = what(missing),
                      head = fmt::format("{} {} {}", who(missing), verb(missing), thing);
    const auto disabled = [&](const WriteRecord* write) { return &graph_.disabled[write->disabled]; };
    if (missing.cause == MissingRead::Cause::condition) {
      report(missing, Code::conditionLeavesSlotEmpty,
             fmt::format("{}: slot '{}' is left empty, the condition of '{}' is false", who(missing),
                         missing.slot, missing.ref.text),
             {kMayBeEmpty});
    } else if (missing.cause == MissingRead::Cause::import) {
      report(missing, Code::emptyImport,
             fmt::format("{} {} '{}', which has nothing now", who(missing), verb(missing), missing.ref.text),
             {"provide it", kMayBeEmpty});
    } else if (writers.removed) {
      collect(missing, {.thing = thing, .removed = writers.removed});
    } else if (writers.disabledEarlier) {
      collect(missing, {.thing = thing, .disabled = disabled(writers.disabledEarlier)});
    } else if (const EmptyRepeat* empty = writers.empty) {
      reportedRepeats_.insert(empty->pass);
      report(missing, Code::disabledWriter,
             fmt::format("{}, but pass '{}' that would write it is not there once: its \"repeat\" is empty",
                         head, empty->pass),
             {rangeHint(*empty), orClear(missing)}, rangeText(*empty));
    } else if (writers.enabledLater && missing.pass != kNone) {
      const std::string& later = graph_.passNames[writers.enabledLater->pass];
      if (const std::string path = cycle(missing.pass, writers.enabledLater->pass); !path.empty())
        report(missing, Code::passCycle, fmt::format("passes wait for each other: {}", path),
               {orBefore(missing)});
      else
        report(missing, Code::readBeforeWrite, fmt::format("{} before pass '{}' writes it", head, later),
               {fmt::format("move '{}' before it", later),
                missing.access == Access::modify ? orClear(missing) : orBefore(missing)});
    } else if (writers.self && !writers.self->whole && missing.access == Access::read) {
      // A pass reads what it writes itself, and neither is a whole resource: there is no earlier version of it.
      const std::string& name = missing.ref.name;
      report(
          missing, Code::readAndWritten, fmt::format("{} and writes it in one go", head),
          {fmt::format(
               "read a level, layer or element that an earlier pass wrote, such as '{}.mip[i-1]' in a pass "
               "that writes '{}.mip[i]'",
               name, name),
           orBefore(missing)});
    } else if (writers.disabledLater && !writers.self) {
      collect(missing, {.thing = thing, .disabled = disabled(writers.disabledLater)});
    } else {
      collect(missing, {.thing = thing});
    }
  }

  void collect(const MissingRead& missing, MissedThing missed) {
    const auto [at, fresh] =
        missedAt_.try_emplace({missed.thing, missed.disabled, missed.removed}, missed_.size());
    if (fresh) missed_.push_back(std::move(missed));
    missed_[at->second].reads.push_back(&missing);
  }

  // However many passes read it, one that writes it is missing: said at the first that lives.
  void report(const MissedThing& missed) {
    const auto live =
        std::ranges::find_if(missed.reads, [&](const MissingRead* read) { return isLive(*read); });
    const MissingRead& first = live == missed.reads.end() ? *missed.reads.front() : **live;
    std::set<std::string> readers, passes;
    for (const MissingRead* read : missed.reads) {
      if (isLive(*read) != isLive(first)) continue;
      readers.insert(read->pass == kNone ? who(*read) : graph_.specs[read->pass].declared);
      if (read->pass != kNone) passes.insert(graph_.specs[read->pass].declared);
    }
    const std::string more =
        readers.size() < 2 ? verb(first)
                           : fmt::format("and {} more read",
                                         readers.size() == 2 ? "one" : fmt::to_string(readers.size() - 1));
    const std::string head = fmt::format("{} {} {}", who(first), more, missed.thing);
    if (missed.disabled) {
      std::vector<std::string> fixes;
      const auto isSwitch = [&](const Disable& each) { return sourceOf(each) == missed.disabled->why; };
      if (std::ranges::none_of(model_.settings.disables, isSwitch))
        fixes.push_back(fmt::format("enable '{}'", missed.disabled->name));
      if (!passes.empty() && passes.size() <= 4)
        fixes.push_back(fmt::format("disable '{}' too", fmt::join(passes, "' and '")));
      if (first.pass == kNone && first.slot != "present")
        fixes.emplace_back("end the reference with '?' to leave the output out when nothing writes it");
      else if (first.pass != kNone && first.access == Access::read)
        fixes.emplace_back(kMayBeEmpty);
      fixes.push_back(orClear(first));
      report(first, Code::disabledWriter,
             fmt::format("{}, but pass '{}' that would write it is disabled ({})", head,
                         missed.disabled->name, missed.disabled->why),
             fixes);
    } else if (missed.removed) {
      const Place& place = missed.removed->place;
      report(first, Code::disabledWriter,
             fmt::format("{}, but pass '{}' that would write it is removed", head, missed.removed->name),
             {fmt::format("let another pass write '{}' before it", resourceOf(first)), orClear(first)},
             place.file ? fmt::format("\"remove\" at {}:{}:{}", *place.file, place.line, place.column) : "");
    } else if (first.pass == kNone && first.slot == "present") {
      report(first, Code::presentsUnwritten,
             fmt::format("present shows {}, which no pass writes", missed.thing),
             {"name a texture that the last pass writes"});
    } else if (first.access == Access::modify) {
      std::vector<std::string> fixes{orClear(first)};
      if (graph_.specs[first.pass].geometry.empty())  // a draw covers a part
        fixes.insert(fixes.begin(), "use \"write\" if the pass covers everything");
      report(first, Code::readBeforeWrite, head + ", which nothing wrote before", fixes);
    } else if (writesIt(first)) {
      report(first, Code::readBeforeWrite, head + ", which nothing wrote before",
             {orClear(first), orBefore(first)});
    } else {
      report(first, Code::nobodyWrites, head + ", which no pass writes",
             {"let a pass before it write it", orClear(first)});
    }
  }

  // Whether the pass of a read writes the same resource.
  bool writesIt(const MissingRead& missing) const {
    const auto records = byEntity_.find(missing.wanted.empty() ? kNone : missing.wanted.front().entity);
    return records != byEntity_.end() && missing.pass != kNone &&
           std::ranges::any_of(records->second,
                               [&](const WriteRecord* write) { return write->pass == missing.pass; });
  }

  // Nobody needs what it would write, and yet nobody writes a range to have nothing.
  void warnOfEmpty(const EmptyRepeat& empty) {
    auto& d = model_.diagnostics.warning(
        Code::culledUnread, empty.place,
        fmt::format("pass '{}' is not there once: its \"repeat\" is empty", empty.pass));
    d.pass = empty.pass;
    d.found = rangeText(empty);
    d.hint = rangeHint(empty);
  }

  // "a -> b -> a" when `last`, which would write what `first` reads, depends on `first`; else "".
  std::string cycle(std::uint32_t first, std::uint32_t last) {
    if (++searches_ > 64) return {};  // enough cycles were named
    std::vector<std::uint32_t> next(graph_.passes.size(), kNone), queue{last};
    next[last] = last;
    for (std::size_t at = 0; at < queue.size() && next[first] == kNone; ++at) {
      const std::uint32_t pass = queue[at];
      const auto reach = [&](std::uint32_t before) {
        if (before >= next.size() || next[before] != kNone) return;
        next[before] = pass;
        queue.push_back(before);
      };
      const FlatPass& flat = graph_.passes[pass];
      for (std::uint32_t use = flat.firstUse; use < flat.firstUse + flat.useCount; ++use)
        if (graph_.uses[use].history == 0)
          graph_.links.forEachWriter(graph_.links.seen[use],
                                     [&](std::uint32_t writer) { reach(graph_.links.passOf[writer]); });
      if (const auto would = wouldRead_.find(pass); would != wouldRead_.end())
        for (const std::uint32_t before : would->second) reach(before);
    }
    if (next[first] == kNone) return {};
    std::string path;
    for (std::uint32_t pass = first; pass != last; pass = next[pass]) path += graph_.passNames[pass] + " -> ";
    return fmt::format("{}{} -> {}", path, graph_.passNames[last], graph_.passNames[first]);
  }

  Model& model_;
  FlatGraph& graph_;
  Liveness live_;
  std::map<std::uint32_t, std::vector<const WriteRecord*>> byEntity_;
  std::map<std::uint32_t, std::vector<std::uint32_t>>
      wouldRead_;  // per pass, what a pass below it would give it
  std::vector<MissedThing> missed_;
  std::map<std::tuple<std::string, const DisabledPass*, const RemovedPass*>, std::size_t> missedAt_;
  std::set<std::string> reported_, reportedRepeats_;
  int searches_ = 0;
};

}  // namespace

void reportMissingReads(Model& model) {
  if (!model.missing.empty() || std::ranges::any_of(model.emptied, &EmptyRepeat::mistake))
    MissingReadReporter(model).run();
}

}  // namespace weft::graph::expansion
