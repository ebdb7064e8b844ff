#include "engine/graph/expand/judge/missing.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "engine/graph/expand/judge/remedy.h"
#include "engine/graph/expand/names/resources.h"
#include "engine/graph/expand/names/unread.h"
#include "engine/graph/versions/live.h"

namespace weft::graph::expansion {

namespace {

bool touches(const Model& model, const WriteRecord& write, const MissingRead::Wanted& wanted) {
  if (write.entity != wanted.entity || wanted.element < write.firstElement ||
      wanted.element >= write.firstElement + write.elementCount)
    return false;
  return holds(write.rect, subresourceAt(wanted.subresource, model.entities[wanted.entity].shape));
}

struct Writers {
  const WriteRecord* disabledEarlier = nullptr;
  const WriteRecord* enabledLater = nullptr;
  const WriteRecord* disabledLater = nullptr;
  const WriteRecord* self = nullptr;
  bool incomplete = false;  // a pass left out for its mistakes may be the writer
};

class Judge {
 public:
  explicit Judge(Model& model) : model_(model), graph_(model.graph), live_(findLive(model.graph)) {
    for (std::uint32_t i = 0; i < model.writes.size(); ++i) byEntity_[model.writes[i].entity].push_back(i);
    found_.reserve(model.missing.size());
    for (const MissingRead& missing : model.missing) {
      if (isOver(model_)) return;
      found_.push_back(findWriters(missing));
      if (missing.pass != kNone && found_.back().enabledLater)
        wouldRead_[missing.pass].push_back(found_.back().enabledLater->pass);
    }
  }

  void run() {
    for (std::size_t i = 0; i < model_.missing.size() && !isOver(model_); ++i)
      judge(model_.missing[i], found_[i]);
    for (const Group& group : groups_)
      if (!isOver(model_)) sayOf(group);
    for (const EmptyRepeat& empty : model_.emptied)
      if (empty.mistake && !isOver(model_) && blamed_.insert(empty.pass).second) warnOfEmpty(empty);
  }

 private:
  Writers findWriters(const MissingRead& missing) const {
    Writers writers;
    writers.incomplete = model_.incomplete;
    for (const MissingRead::Wanted& wanted : missing.wanted) {
      writers.incomplete = writers.incomplete || model_.entities[wanted.entity].incomplete;
      const auto records = byEntity_.find(wanted.entity);
      if (records == byEntity_.end()) continue;
      for (const std::uint32_t index : records->second) {
        const WriteRecord& write = model_.writes[index];
        if (!touches(model_, write, wanted)) continue;
        if (write.pass != kNone && write.pass == missing.pass)
          writers.self = &write;
        else if (write.disabled != kNone && write.position < missing.position)
          writers.disabledEarlier =
              write.passesOn && writers.disabledEarlier ? writers.disabledEarlier : &write;
        else if (write.disabled != kNone && !writers.disabledLater)
          writers.disabledLater = &write;
        else if (write.pass != kNone && write.position > missing.position && !writers.enabledLater &&
                 !write.passesOn)
          writers.enabledLater = &write;
      }
    }
    return writers;
  }

  std::string who(const MissingRead& missing) const {
    if (missing.pass != kNone) return fmt::format("pass '{}'", graph_.passNames[missing.pass]);
    return missing.slot == "present" ? "present" : fmt::format("output '{}'", missing.slot);
  }

  std::string what(const MissingRead& missing) const {
    if (missing.wanted.empty()) return fmt::format("'{}'", missing.ref.text);
    const MissingRead::Wanted& wanted = missing.wanted.front();
    const Entity& entity = model_.entities[wanted.entity];
    const std::string element = entity.arrayCount > 0 ? fmt::format("[{}]", wanted.element) : "";
    const std::string part = subresourceText(entity.shape, wanted.subresource);
    const std::string text = part.empty() ? fmt::format("'{}{}'", entity.name, element)
                                          : fmt::format("{} of '{}{}'", part, entity.name, element);
    return missing.wanted.size() == 1
               ? text
               : fmt::format("'{}' ({} and its other alternatives)", missing.ref.text, text);
  }

  base::Diagnostic* report(const MissingRead& missing, Code code, std::string message) {
    const Place& place = missing.ref.place;
    const bool live = isLive(missing);
    const std::string key =
        fmt::format("{} {} {} {} {}", static_cast<int>(code), place.line, place.column, live,
                    missing.pass == kNone ? missing.slot : graph_.specs[missing.pass].declared);
    if (!said_.insert(key).second) return nullptr;  // another repeat of the same stanza
    base::Diagnostic d;
    d.severity = live ? base::Severity::error : base::Severity::warning;
    d.code = code;
    d.message = std::move(message);
    d.place = place;
    if (missing.pass != kNone) d.pass = graph_.passNames[missing.pass];
    d.resource =
        missing.wanted.empty() ? missing.ref.name : model_.entities[missing.wanted.front().entity].name;
    d.found = missing.ref.text;
    return &model_.diagnostics.add(std::move(d));
  }

  const char* verb(const MissingRead& missing) const {
    return missing.pass == kNone              ? (missing.slot == "present" ? "shows" : "reads")
           : missing.access == Access::modify ? "modifies"
                                              : "reads";
  }

  // What else would help. A first value has no earlier publication: nothing comes before it.
  static std::string orBefore(const MissingRead& missing, const char* when) {
    return missing.first ? std::string(", or name another texture or buffer as \"first\"")
                         : fmt::format(", or read '{}@-1' for what it was {}", missing.ref.name, when);
  }

  void judge(const MissingRead& missing, const Writers& writers) {
    const std::string thing = what(missing), subject = who(missing);
    const bool slot = missing.pass != kNone;
    if (missing.cause == MissingRead::Cause::condition) {
      if (model_.toInclude)
        return;  // what the reference stands for is bound by the file that includes this one
      if (std::ranges::any_of(model_.scopes, failedInclude)) return;  // which may have what it waits for
      if (auto* d = report(missing, Code::conditionLeavesSlotEmpty,
                           fmt::format("{}: slot '{}' is left empty, the condition of '{}' is false", subject,
                                       missing.slot, missing.ref.text)))
        d->hint =
            "end it with '?' if the shader can do without (no HAS_…), or read a resource that is a list of "
            "alternatives";
    } else if (missing.cause == MissingRead::Cause::import) {
      if (auto* d = report(
              missing, Code::emptyImport,
              fmt::format("{} {} '{}', which has nothing now", subject, verb(missing), missing.ref.text)))
        d->hint =
            "provide it, or end the reference with '?', or read a resource that is a list of alternatives";
    } else if (const RemovedPass* removed = removedWriter(missing)) {
      groupOf(thing, kNone, removed).reads.push_back(&missing);
    } else if (writers.disabledEarlier) {
      groupOf(thing, writers.disabledEarlier->disabled).reads.push_back(&missing);
    } else if (const EmptyRepeat* empty = emptyWriter(missing)) {
      judgeEmpty(missing, *empty, thing, subject);
    } else if (writers.incomplete) {
      return;
    } else if (writers.enabledLater && slot) {
      judgeLater(missing, *writers.enabledLater, thing, subject);
    } else if (writers.self && !writers.self->whole && missing.access == Access::read) {
      judgeOwnLevel(missing, thing, subject);
    } else if (writers.disabledLater && !writers.self) {
      groupOf(thing, writers.disabledLater->disabled).reads.push_back(&missing);
    } else {
      groupOf(thing, kNone).reads.push_back(&missing);
    }
  }

  // Reads that miss the same thing, because a pass is disabled or removed, or because none writes it.
  struct Group {
    std::string thing;
    std::uint32_t disabled = kNone;
    const RemovedPass* removed = nullptr;
    std::vector<const MissingRead*> reads;
  };

  Group& groupOf(const std::string& thing, std::uint32_t disabled, const RemovedPass* removed = nullptr) {
    const auto [at, fresh] = groupAt_.try_emplace({thing, disabled, removed}, groups_.size());
    return fresh ? groups_.emplace_back(Group{thing, disabled, removed, {}}) : groups_[at->second];
  }

  bool isLive(const MissingRead& missing) const {
    return missing.pass == kNone || live_.pass[missing.pass] != 0;
  }

  // However many passes read it, one that writes it is missing: said at the first that lives.
  void sayOf(const Group& group) {
    const auto& reads = group.reads;
    const auto live = std::ranges::find_if(reads, [&](const MissingRead* read) { return isLive(*read); });
    const MissingRead& first = live == reads.end() ? *reads.front() : **live;
    std::vector<std::string> passes;  // that need it
    std::size_t all = 0;
    for (const MissingRead* read : reads) {
      if (isLive(*read) != isLive(first)) continue;
      const std::string name = read->pass == kNone ? who(*read) : graph_.specs[read->pass].declared;
      if (!said_.insert(fmt::format("{} needs {}", name, group.thing)).second) continue;
      ++all;
      if (read->pass != kNone) passes.push_back(name);
    }
    const bool reading =
        std::ranges::all_of(reads, [](const MissingRead* read) { return read->access == Access::read; });
    const std::string more = all < 2
                                 ? fmt::format(" {}", verb(first))
                                 : fmt::format(" and {} more {}", all == 2 ? "one" : fmt::to_string(all - 1),
                                               reading ? "read" : "need");
    const std::string head = fmt::format("{}{} {}", who(first), more, group.thing);
    const std::string resource =
        first.wanted.empty() ? first.ref.name : model_.entities[first.wanted.front().entity].name;
    std::vector<std::string> fixes;
    if (const std::string shown =
            first.wanted.empty() ? "" : otherPresent(model_, first.wanted.front().entity, first.position);
        !shown.empty())
      fixes.push_back(fmt::format("{} shows what is there", shown));
    base::Diagnostic* d = nullptr;
    if (group.disabled != kNone) {
      const DisabledPass& disabled = graph_.disabled[group.disabled];
      d = report(first, Code::disabledWriter,
                 fmt::format("{}, but pass '{}' that would write it is disabled ({})", head, disabled.name,
                             disabled.why));
      if (!isSwitchedOff(model_, disabled))
        fixes.insert(fixes.begin(), fmt::format("enable '{}'", disabled.name));
      if (const std::string names = namesToDisable(passes, disabled.name); !names.empty())
        fixes.push_back(fmt::format("disable {} too", names));
      if (first.pass == kNone && first.slot != "present")
        fixes.push_back("end the reference with '?' to leave the output out when nothing writes it");
      if (first.access == Access::read && first.pass != kNone)
        fixes.push_back(
            "end the reference with '?' if the shader can do without, or read a resource that is a list of "
            "alternatives");
    } else if (group.removed) {
      d = report(first, Code::disabledWriter,
                 fmt::format("{}, but pass '{}' that would write it is removed", head, group.removed->name));
      if (const Place& place = group.removed->place; d && place.file)
        d->found = fmt::format("\"remove\" at {}:{}:{}", *place.file, place.line, place.column);
      fixes.push_back(fmt::format("let another pass write '{}' before it", resource));
    } else if (first.pass == kNone && first.slot == "present") {
      d = report(first, Code::presentsUnwritten,
                 fmt::format("present shows {}, which no pass writes", group.thing));
      if (fixes.empty()) fixes.emplace_back("name a texture that the last pass writes");
    } else if (first.access == Access::modify || readsOwn(first)) {
      d = report(first, Code::readBeforeWrite, head + ", which nothing wrote before");
      if (first.access == Access::modify &&
          graph_.specs[first.pass].geometry.empty())  // a draw covers a part
        fixes.emplace_back("use \"write\" if the pass covers everything");
    } else {
      d = report(first, Code::nobodyWrites, head + ", which no pass writes");
      fixes.emplace_back("let a pass before it write it");
    }
    if (!d) return;
    if (d->code != Code::presentsUnwritten) fixes.push_back(fmt::format("give '{}' a \"clear\"", resource));
    if (d->code == Code::readBeforeWrite && first.access == Access::read)
      fixes.push_back(orBefore(first, "before").substr(5));
    for (const std::string& fix : fixes) d->hint += (d->hint.empty() ? "" : ", or ") + fix;
  }

  // Whether the pass of a read writes the same resource.
  bool readsOwn(const MissingRead& missing) const {
    const auto records = byEntity_.find(missing.wanted.empty() ? kNone : missing.wanted.front().entity);
    return records != byEntity_.end() && missing.pass != kNone &&
           std::ranges::any_of(records->second,
                               [&](std::uint32_t i) { return model_.writes[i].pass == missing.pass; });
  }

  // A pass that an overlay took out and that would write what is missing, or null.
  const RemovedPass* removedWriter(const MissingRead& missing) const {
    for (const MissingRead::Wanted& wanted : missing.wanted) {
      const Entity& entity = model_.entities[wanted.entity];
      if (!entity.desc) continue;
      for (const RemovedPass& removed : entity.scope->desc->removed)
        if (std::ranges::find(removed.writes, entity.desc->name) != removed.writes.end()) return &removed;
    }
    return nullptr;
  }

  // A pass that does not repeat even once and that would write what is missing, or null.
  const EmptyRepeat* emptyWriter(const MissingRead& missing) const {
    for (const MissingRead::Wanted& wanted : missing.wanted)
      if (const std::uint32_t empty = model_.entities[wanted.entity].emptied; empty != kNone)
        return &model_.emptied[empty];
    return nullptr;
  }

  void judgeEmpty(const MissingRead& missing, const EmptyRepeat& empty, const std::string& thing,
                  const std::string& subject) {
    auto* d = report(
        missing, Code::disabledWriter,
        fmt::format("{} {} {}, but pass '{}' that would write it is not there once: its \"repeat\" is empty",
                    subject, verb(missing), thing, empty.pass));
    if (!d) return;
    blamed_.insert(empty.pass);
    d->found = fmt::format("\"{}\": [{}, {}{}]", empty.index, empty.first, empty.last,
                           empty.step == 1 ? "" : fmt::format(", {}", empty.step));
    const std::string clear = fmt::format("give '{}' a \"clear\"", d->resource);
    d->hint = empty.step > 0 && empty.first > empty.last
                  ? fmt::format("a range counts down with a step: \"{}\": [{}, {}, -1]; or {}", empty.index,
                                empty.first, empty.last, clear)
                  : fmt::format("let the range have an index, or {}", clear);
  }

  // Nobody needs what it would write, and yet nobody writes a range to have nothing.
  void warnOfEmpty(const EmptyRepeat& empty) {
    auto& d = model_.diagnostics.warning(
        Code::culledUnread, empty.place,
        fmt::format("pass '{}' is not there once: its \"repeat\" is empty", empty.pass));
    d.pass = empty.pass;
    d.found = fmt::format("\"{}\": [{}, {}{}]", empty.index, empty.first, empty.last,
                          empty.step == 1 ? "" : fmt::format(", {}", empty.step));
    d.hint = fmt::format("a range counts {}: \"{}\": [{}, {}{}]",
                         empty.step > 0 ? "down with a step" : "up without a negative step", empty.index,
                         empty.first, empty.last, empty.step > 0 ? ", -1" : "");
  }

  // A pass reads what it writes itself, and neither is a whole resource: there is no earlier version of it.
  void judgeOwnLevel(const MissingRead& missing, const std::string& thing, const std::string& subject) {
    auto* d = report(missing, Code::readAndWritten,
                     fmt::format("{} reads {} and writes it in one go", subject, thing));
    if (!d) return;
    d->expected = "a level, layer or element that an earlier pass wrote";
    d->hint = fmt::format(
        "name one, such as '{}.mip[i-1]' in a pass that writes '{}.mip[i]', or read '{}@-1' "
        "for what it was in the frame before",
        missing.ref.name, missing.ref.name, missing.ref.name);
  }

  void judgeLater(const MissingRead& missing, const WriteRecord& writer, const std::string& thing,
                  const std::string& subject) {
    const std::string& later = graph_.passNames[writer.pass];
    if (const std::string path = cycle(missing.pass, writer.pass); !path.empty()) {
      if (auto* d = report(missing, Code::passCycle, fmt::format("passes wait for each other: {}", path)))
        d->hint = fmt::format(
            "'{}' would write {}{}", later, thing,
            missing.first
                ? std::string(": name another texture or buffer as \"first\"")
                : fmt::format("; read '{}@-1' for what it was in the frame before", missing.ref.name));
      return;
    }
    if (auto* d =
            report(missing, Code::readBeforeWrite,
                   fmt::format("{} {} {} before pass '{}' writes it", subject, verb(missing), thing, later)))
      d->hint = missing.access == Access::modify
                    ? fmt::format("move '{}' before it, or give '{}' a \"clear\"", later, d->resource)
                    : fmt::format("move '{}' before it{}", later, orBefore(missing, "in the frame before"));
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
    for (std::uint32_t pass = first;; pass = next[pass]) {
      path += graph_.passNames[pass] + " -> ";
      if (pass == last) break;
    }
    return path + graph_.passNames[first];
  }

  Model& model_;
  FlatGraph& graph_;
  Liveness live_;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> byEntity_;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> wouldRead_;
  std::vector<Writers> found_;
  std::vector<Group> groups_;
  std::map<std::tuple<std::string, std::uint32_t, const RemovedPass*>, std::size_t> groupAt_;
  std::set<std::string> said_;
  std::set<std::string> blamed_;  // passes with an empty "repeat" that an error names
  int searches_ = 0;
};

}  // namespace

void judgeMissing(Model& model) {
  if (!model.missing.empty() || std::ranges::any_of(model.emptied, &EmptyRepeat::mistake)) Judge(model).run();
}

}  // namespace weft::graph::expansion
