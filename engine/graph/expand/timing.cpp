#include "engine/graph/expand/timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/graph/expand/judge/remedy.h"

namespace weft::graph::expansion {

namespace {

// Every sub-resource that the slot means was written, not only cleared.
bool isWritten(const Model& model, const SlotWork& work) {
  bool written = true;
  for (std::uint32_t e = work.firstElement; written && e < work.firstElement + work.elementCount; ++e) {
    FlatUse use = work.use;
    use.resource = model.entities[work.entity].elements[e].resource;
    if (use.resource == kNone) return false;
    model.versions.forEachRun(use, [&](std::uint32_t writer, std::uint32_t, std::uint32_t) {
      written = written && writer != kNone;
      return written;
    });
  }
  return written;
}

}  // namespace

std::uint32_t timingOf(Model& model, Scope& scope, const PassDesc& desc, std::uint32_t outer) {
  const bool own = isDynamic(model, scope, desc.enabled);
  if (!own && outer == 0) return 0;
  const std::string what = desc.include ? fmt::format("include '{}'", scope.prefix + desc.include->as)
                                        : fmt::format("pass '{}'", scope.prefix + desc.name);
  const auto refuse = [&](std::string message, const char* hint) {
    auto& d = model.diagnostics.error(Code::badTime, own ? desc.enabled.place() : desc.namePlace,
                                      std::move(message));
    d.pass = desc.include ? "" : scope.prefix + desc.name;
    d.hint = hint;
    return 0u;
  };
  if (own && outer != 0)
    return refuse(fmt::format("{} has an \"enabled\" with age() inside an include that has one", what),
                  "put both conditions into one of them");
  if (!desc.include && desc.cadence != Cadence::always)
    return refuse(fmt::format("{} is enabled by age(), but does not run in every frame", what),
                  "age() belongs into passes that are \"update\": \"always\"");
  if (outer != 0) return outer;
  for (const RangeDesc& range : desc.repeat)
    if (desc.enabled.says(range.index))
      return refuse(
          fmt::format("{} has an \"enabled\" with age() that depends on the index '{}'", what, range.index),
          "write a stanza for each");
  const auto next = static_cast<std::uint32_t>(model.timings.size()) + 1;
  const auto [known, isNew] = model.timingByText.try_emplace({&scope, desc.enabled.text()}, next);
  if (isNew) model.timings.push_back({&desc.enabled, &scope});
  return known->second;
}

void reportMadeAtTimes(const SlotContext& context, const SlotDesc& slot, const SlotWork& work) {
  const Entity& entity = context.model.entities[work.entity];
  const Timing& timing = context.model.timings[entity.timing - 1];
  for (const auto& [fact, name] : timing.expr->facts())
    if (context.model.unknownFacts.contains({timing.scope, name})) return;  // one mistake
  auto& d = context.model.diagnostics.error(
      Code::madeAtTimes, slot.ref.place,
      fmt::format("{} {} '{}', which is made only at times", context.user,
                  slot.access == Access::read ? "reads" : "modifies", slot.ref.text));
  d.pass = context.pass;
  d.resource = entity.name;
  d.found = fmt::format("'{}' is made while {}", entity.name, timing.expr->text());
  const auto off = std::ranges::find_if(context.model.writes, [&](const WriteRecord& write) {
    return write.disabled != kNone && write.entity == work.entity;
  });
  if (off != context.model.writes.end()) {
    const DisabledPass& disabled = context.model.graph.disabled[off->disabled];
    d.found += fmt::format(", and pass '{}' that writes it in every frame is disabled ({})", disabled.name,
                           disabled.why);
    if (!isSwitchedOff(context.model, disabled)) d.hint = fmt::format("enable '{}', or ", disabled.name);
    std::vector<std::string> makers;
    for (const WriteRecord& write : context.model.writes)
      if (write.pass != kNone && write.entity == work.entity)
        makers.push_back(context.model.graph.specs[write.pass].declared);
    const std::string names = namesToDisable(makers, disabled.name);
    d.hint += fmt::format("disable {} too", names.empty() ? "what makes it at times" : names);
    return;
  }
  d.hint = "give it the same \"enabled\" as those that write it, or have them modify what is always made";
}

bool mayMake(const SlotContext& context, const SlotWork& work) {
  Entity& entity = context.model.entities[work.entity];
  const bool first = !std::exchange(entity.made, true);
  if (first) entity.timing = context.timing;
  const bool changes = work.slot->access == Access::modify;
  const auto refuse = [&](std::string_view why, const char* hint) {
    auto& d = context.model.diagnostics.error(
        Code::madeAtTimes, work.slot->ref.place,
        fmt::format("{} {} '{}', which {}", context.user, changes ? "modifies" : "writes",
                    work.slot->ref.text, why));
    d.pass = context.pass;
    d.resource = entity.name;
    d.hint = hint;
    return false;
  };
  if (entity.timing == context.timing) {
    if (context.timing == 0 || entity.depth == 0) return true;
    return refuse("keeps a history, but only at times", "write it in every frame, or take \"history\" away");
  }
  if (entity.timing != 0)
    return refuse("other passes make only at times",
                  "give the passes one \"enabled\", or this one a resource of its own");
  if (changes && isWritten(context.model, work)) return true;
  return refuse("is there at all times", "at times it can be modified, once all of it is written");
}

}  // namespace weft::graph::expansion
