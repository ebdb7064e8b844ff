#include "engine/graph/expand/live.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/graph/expand/names/limits.h"
#include "engine/graph/expand/names/resources.h"
#include "engine/graph/versions/live.h"

namespace weft::graph::expansion {

namespace {

// ---- missing versions ----

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
  bool self = false;
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
  }

 private:
  Writers findWriters(const MissingRead& missing) const {
    Writers writers;
    for (const MissingRead::Wanted& wanted : missing.wanted) {
      const auto records = byEntity_.find(wanted.entity);
      if (records == byEntity_.end()) continue;
      if (!compare(model_, records->second.size(), missing.ref->place)) break;
      for (const std::uint32_t index : records->second) {
        const WriteRecord& write = model_.writes[index];
        if (!touches(model_, write, wanted)) continue;
        if (write.pass != kNone && write.pass == missing.pass)
          writers.self = true;
        else if (write.disabled != kNone && write.position < missing.position)
          writers.disabledEarlier = &write;
        else if (write.disabled != kNone && !writers.disabledLater)
          writers.disabledLater = &write;
        else if (write.pass != kNone && write.position > missing.position && !writers.enabledLater)
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
    if (missing.wanted.empty()) return fmt::format("'{}'", missing.ref->text);
    const MissingRead::Wanted& wanted = missing.wanted.front();
    const Entity& entity = model_.entities[wanted.entity];
    const std::string element = entity.arrayCount > 0 ? fmt::format("[{}]", wanted.element) : "";
    const std::string part = subresourceText(entity.shape, wanted.subresource);
    const std::string text = part.empty() ? fmt::format("'{}{}'", entity.name, element)
                                          : fmt::format("{} of '{}{}'", part, entity.name, element);
    return missing.wanted.size() == 1
               ? text
               : fmt::format("'{}' ({} and its other alternatives)", missing.ref->text, text);
  }

  base::Diagnostic* report(const MissingRead& missing, Code code, std::string message) {
    const Place& place = missing.ref->place;
    const std::string key =
        fmt::format("{} {} {} {}", static_cast<int>(code), place.line, place.column,
                    missing.pass == kNone ? missing.slot : graph_.specs[missing.pass].declared);
    if (!said_.insert(key).second) return nullptr;  // another repeat of the same stanza
    const bool live = missing.pass == kNone || live_.pass[missing.pass] != 0;
    base::Diagnostic d;
    d.severity = live ? base::Severity::error : base::Severity::warning;
    d.code = code;
    d.message = std::move(message);
    d.place = place;
    d.pointer = missing.ref->pointer;
    if (missing.pass != kNone) d.pass = graph_.passNames[missing.pass];
    d.resource =
        missing.wanted.empty() ? missing.ref->name : model_.entities[missing.wanted.front().entity].name;
    d.found = missing.ref->text;
    return &model_.diagnostics.add(std::move(d));
  }

  const char* verb(const MissingRead& missing) const {
    return missing.pass == kNone              ? (missing.slot == "present" ? "shows" : "reads")
           : missing.access == Access::modify ? "modifies"
                                              : "reads";
  }

  void judge(const MissingRead& missing, const Writers& writers) {
    const std::string thing = what(missing), subject = who(missing);
    const bool slot = missing.pass != kNone;
    if (missing.cause == MissingRead::Cause::condition) {
      if (auto* d = report(missing, Code::conditionLeavesSlotEmpty,
                           fmt::format("{}: slot '{}' is left empty, the condition of '{}' is false", subject,
                                       missing.slot, missing.ref->text)))
        d->hint =
            "end it with '?' if the shader can do without (no HAS_…), or read a resource that is a list of "
            "alternatives";
    } else if (missing.cause == MissingRead::Cause::import) {
      if (auto* d = report(
              missing, Code::emptyImport,
              fmt::format("{} {} '{}', which has nothing now", subject, verb(missing), missing.ref->text)))
        d->hint =
            "provide it, or end the reference with '?', or read a resource that is a list of alternatives";
    } else if (writers.disabledEarlier) {
      judgeDisabled(missing, *writers.disabledEarlier, thing, subject);
    } else if (writers.enabledLater && slot) {
      judgeLater(missing, *writers.enabledLater, thing, subject);
    } else if (writers.self && !model_.incomplete) {
      if (auto* d =
              report(missing, Code::readBeforeWrite,
                     fmt::format("{} {} {}, which nothing wrote before", subject, verb(missing), thing)))
        d->hint = missing.access == Access::modify
                      ? fmt::format("use \"write\" if the pass covers everything, or give '{}' a \"clear\"",
                                    d->resource)
                      : fmt::format("give '{}' a \"clear\", or read '{}@-1' for what it was before",
                                    d->resource, missing.ref->name);
    } else if (writers.disabledLater) {
      judgeDisabled(missing, *writers.disabledLater, thing, subject);
    } else if (model_.incomplete) {
      return;  // a pass that was left out for its mistakes may be the writer
    } else if (missing.slot == "present" && !slot) {
      if (auto* d = report(missing, Code::presentsUnwritten,
                           fmt::format("present shows {}, which no pass writes", thing)))
        d->hint = "name a texture that the last pass writes";
    } else if (missing.access == Access::modify) {
      if (auto* d = report(missing, Code::readBeforeWrite,
                           fmt::format("{} modifies {}, which nothing wrote before", subject, thing)))
        d->hint =
            fmt::format("use \"write\" if the pass covers everything, or give '{}' a \"clear\"", d->resource);
    } else if (auto* d = report(missing, Code::nobodyWrites,
                                fmt::format("{} reads {}, which no pass writes", subject, thing))) {
      d->hint = fmt::format("let a pass before it write it, or give '{}' a \"clear\"", d->resource);
    }
  }

  void judgeDisabled(const MissingRead& missing, const WriteRecord& writer, const std::string& thing,
                     const std::string& subject) {
    const DisabledPass& disabled = graph_.disabled[writer.disabled];
    auto* d = report(missing, Code::disabledWriter,
                     fmt::format("{} {} {}, but pass '{}' that would write it is disabled ({})", subject,
                                 verb(missing), thing, disabled.name, disabled.why));
    if (!d) return;
    d->hint = fmt::format("enable '{}'", disabled.name);
    if (missing.pass == kNone) return;
    if (missing.access == Access::read)
      d->hint += fmt::format(
          ", or disable '{}' too, or end the reference with '?' if the shader can do without, or read a "
          "resource that is a list of alternatives",
          graph_.specs[missing.pass].declared);
    d->hint += fmt::format(", or give '{}' a \"clear\"", d->resource);
  }

  void judgeLater(const MissingRead& missing, const WriteRecord& writer, const std::string& thing,
                  const std::string& subject) {
    const std::string& later = graph_.passNames[writer.pass];
    if (const std::string path = cycle(missing.pass, writer.pass); !path.empty()) {
      if (auto* d = report(missing, Code::passCycle, fmt::format("passes wait for each other: {}", path)))
        d->hint = fmt::format("'{}' would write {}; read '{}@-1' for what it was in the frame before", later,
                              thing, missing.ref->name);
      return;
    }
    if (auto* d =
            report(missing, Code::readBeforeWrite,
                   fmt::format("{} {} {} before pass '{}' writes it", subject, verb(missing), thing, later)))
      d->hint = missing.access == Access::modify
                    ? fmt::format("move '{}' before it, or give '{}' a \"clear\"", later, d->resource)
                    : fmt::format("move '{}' before it, or read '{}@-1' for what it was in the frame before",
                                  later, missing.ref->name);
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
  std::set<std::string> said_;
  int searches_ = 0;
};

// ---- culled by mistake ----

bool covers(const WriteRecord& later, const WriteRecord& earlier) {
  return later.rect.access == Access::write && later.firstElement <= earlier.firstElement &&
         earlier.firstElement + earlier.elementCount <= later.firstElement + later.elementCount &&
         covers(later.rect, earlier.rect);
}

struct Fate {
  bool writes = false, intended = false;
  std::uint32_t overwriter = kNone, entity = kNone;
};

}  // namespace

void judgeMissing(Model& model) {
  if (!model.missing.empty()) Judge(model).run();
}

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
  for (Entity& entity : model.entities) std::sort(entity.mentions.begin(), entity.mentions.end());
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
      const auto mention = std::upper_bound(entity.mentions.begin(), entity.mentions.end(), write.position);
      const WriteRecord* overwriter = nullptr;
      for (std::size_t l = r + 1; l < std::min(records.size(), r + 64) && !overwriter; ++l)
        if (const WriteRecord& later = model.writes[records[l]];
            later.position > write.position && covers(later, write))
          overwriter = &later;
      // What an included file makes is its interface: leaving some of it unused is no mistake.
      if (entity.scope->parent && !overwriter) fate.intended = true;
      if (mention != entity.mentions.end() && (!overwriter || *mention <= overwriter->position))
        fate.intended = true;
      if (overwriter && (fate.overwriter == kNone || overwriter->pass < fate.overwriter))
        fate.overwriter = overwriter->pass;
      if (fate.entity == kNone || index < fate.entity) fate.entity = index;
    }
  }
  std::set<std::string_view> said;
  for (std::uint32_t pass = 0; pass < graph.passes.size(); ++pass) {
    const Fate& fate = fates[pass];
    if (live.pass[pass] != 0 || fate.intended || !said.insert(graph.specs[pass].declared).second) continue;
    const PassSpec& spec = graph.specs[pass];
    const std::string resource = fate.entity == kNone ? "" : model.entities[fate.entity].name;
    base::Diagnostic* d = nullptr;
    if (fate.overwriter != kNone) {
      d = &model.diagnostics.warning(
          Code::culledOverwritten, spec.place,
          fmt::format("pass '{}' is culled: '{}' overwrites '{}' before anybody reads it", spec.name,
                      graph.passNames[fate.overwriter], resource));
      d->hint = fmt::format("read '{}' in '{}', or use \"modify\" there, or disable '{}'", resource,
                            graph.passNames[fate.overwriter], spec.declared);
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
