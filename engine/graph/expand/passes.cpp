#include "engine/graph/expand/passes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <deque>
#include <span>

#include "engine/text/limits.h"
#include "graph_sentences.h"

namespace weft::graph::expansion {

namespace {

// Why a pass whose "enabled" is false is disabled. Kept for each instance, so a long expression is cut.
std::string whyFalse(const Expr& enabled) {
  const std::string text = enabled.text();
  if (enabled.isConstant()) return fmt::format("\"enabled\": {}", text);
  return fmt::format("enabled: {:.80}{} is false", text, text.size() > 80 ? "…" : "");
}

using State = SlotWork::State;

// The slots, parameters and defines of one instance; a choice makes a define of each of its words.
std::uint64_t slotsOf(const PassDesc& desc) {
  std::uint64_t count = desc.slots.size() + desc.parameters.size() + desc.defines.size();
  for (const PassParameterDesc& parameter : desc.parameters)
    count += parameter.items.size() + (parameter.declared ? parameter.declared->choices.size() : 0);
  return count;
}

// A range that is empty whatever the settings are can hardly be meant to be: the bound that would make it longer is constant.
bool isEmptyByMistake(const PassDesc& desc, const RangeDesc& range, std::int64_t step) {
  for (const RangeDesc& outer : desc.repeat)
    if (range.first.says(outer.index) || range.last.says(outer.index))
      return false;  // empty for some of them
  return (step > 0 ? range.last : range.first).isConstant();
}

// The "repeat" of a pass is empty, by a range: what it would write says so when it is missing.
void noteEmptyRepeat(Model& model, Scope& scope, const PassDesc& desc, EmptyRepeat empty) {
  const bool first = model.emptied.empty() || model.emptied.back().pass != empty.pass;  // range of the pass
  for (const SlotDesc& slot : desc.slots) {
    const std::uint32_t found = findEntity(model, scope, slot.ref.name, slot.ref.import);
    if (found == kNone) continue;
    if (first) wouldUse(model, found, slot.access, slot.ref.history);
    if (slot.access != Access::read && model.entities[found].emptied == kNone)
      model.entities[found].emptied = static_cast<std::uint32_t>(model.emptied.size());
  }
  ++model.position;
  model.emptied.push_back(std::move(empty));
}

// A stanza, and what holds for all its instances.
struct StanzaWalk {
  Scope& scope;
  const PassDesc& desc;
  const PassType* type;    // null: there is none of the name
  std::string declared;    // "bloom.glow_down"
  const std::string& why;  // its include is disabled; "" when it is not
  std::uint64_t slots;     // of one instance
  bool sound = true;       // checkStanza() found nothing
  bool failed = false;     // an instance has mistakes: the others would say the same
};

class PassWalk {
 public:
  PassWalk(Model& model, std::vector<DeferredUniform>& deferred)
      : model_(model), graph_(model.graph), deferred_(deferred) {}

  void walk(Scope& scope, const std::string& outerWhy) {
    const std::string& why = outerWhy.empty() ? scope.disabledBy : outerWhy;
    for (std::span<const PassDesc> rest = scope.desc->passes; !rest.empty();) {
      if (isOver(model_)) return;
      const PassDesc& desc = rest.front();
      std::size_t count = 1;
      while (count < rest.size() && desc.looped > 0 && rest[count].looped > 0 &&
             rest[count].group == desc.group)
        ++count;
      if (desc.include)
        walkInclude(scope, desc, why);
      else
        walkStanzas(scope, rest.first(count), why);
      rest = rest.subspan(count);
    }
  }

 private:
  void walkInclude(Scope& scope, const PassDesc& desc, const std::string& why) {
    const auto child = scope.includes.find(desc.include->as);
    if (child == scope.includes.end() || child->second->stanza != &desc) return;
    checkExpr(model_, scope, desc.enabled);
    checkExpr(model_, scope, desc.include->screen);
    screenOf(model_, *child->second);
    Names names(model_, scope);
    const auto enabled = evaluateCondition(names, desc.enabled, true, "'enabled' of an include");
    if (enabled) walk(*child->second, why.empty() && !*enabled ? whyFalse(desc.enabled) : why);
  }

  // ---- stanzas and their repeats ----

  // Of one stanza, or of several that repeat together.
  void walkStanzas(Scope& scope, std::span<const PassDesc> descs, const std::string& why) {
    Names names(model_, scope);
    const std::size_t errors = model_.diagnostics.errorCount();
    std::vector<StanzaWalk> stanzas;
    for (const PassDesc& desc : descs) {
      if (scope.passes.find(desc.name)->second != &desc) continue;  // a name that another has
      StanzaWalk stanza{.scope = scope,
                        .desc = desc,
                        .type = findNamed(model_.registry.passTypes, desc.type),
                        .declared = scope.prefix + desc.name,
                        .why = why,
                        .slots = slotsOf(desc)};
      if (stanza.slots > text::raised(kMaxSlotsOfPass))
        return stopAt(model_, desc.place, fmt::format("pass '{}' has too many slots", stanza.declared),
                      kMaxSlotsOfPass, "slots, parameters and defines of one pass");
      stanza.sound = checkStanza({model_, names, stanza.type, {}, stanza.declared}, desc);
      if (stanza.type) stanzas.push_back(std::move(stanza));
    }
    if (!stanzas.empty()) repeat(stanzas, names);
    if (model_.diagnostics.errorCount() > errors)
      for (const PassDesc& desc : descs) leaveOut(scope, desc);
  }

  void leaveOut(Scope& scope, const PassDesc& desc) {
    for (const SlotDesc& slot : desc.slots) {
      if (slot.access == Access::read) continue;
      const std::uint32_t found = findEntity(model_, scope, slot.ref.name, slot.ref.import);
      model_.leftOut.insert(found != kNone && model_.entities[found].isOwn() ? found : kNone);
    }
  }

  // Whether `more` passes may follow; reports otherwise.
  bool mayMake(const StanzaWalk& stanza, std::uint64_t more, const Place& place) {
    const std::uint64_t most = text::raised(kMaxPasses);
    if (made_ + more <= most) return true;
    model_.stopped = true;
    return report(model_, say::tooManyPasses, place, stanza.declared, most,
                  text::hintToRaise(kMaxPasses, made_ + more));
  }

  void repeat(std::span<StanzaWalk> stanzas, Names& names) {
    const std::size_t depth = names.indices.size();
    StanzaWalk& stanza = stanzas.front();
    if (stanzas.size() > 1 && depth == stanza.desc.looped) {
      for (StanzaWalk& each : stanzas)
        if (!each.failed && !isOver(model_)) repeat({&each, 1}, names);
      return;
    }
    if (depth == stanza.desc.repeat.size()) {
      if (!mayMake(stanza, 1, stanza.desc.place)) return;
      ++made_;
      instance(stanza, names);
      ++model_.position;
      return;
    }
    const RangeDesc& range = stanza.desc.repeat[depth];
    constexpr std::int64_t kFar = 1'000'000'000;
    const auto first = evaluateWhole(names, range.first, 0, -kFar, kFar, "a bound of a repeat");
    const auto last = evaluateWhole(names, range.last, 0, -kFar, kFar, "a bound of a repeat");
    const auto step = evaluateWhole(names, range.step, 1, -kFar, kFar, "the step of a repeat");
    if (step && *step == 0) report(model_, say::stepOfZero, range.place, stanza.declared, range.index);
    if (!first || !last || !step || *step == 0) {
      for (StanzaWalk& each : stanzas) each.failed = true;
      return;
    }
    const std::int64_t steps = (*last - *first) / *step + 1;
    // Each step makes a pass, or ends at an empty range within.
    const auto least = static_cast<std::uint64_t>(std::max<std::int64_t>(steps, 1));
    if (!mayMake(stanza, least * stanzas.size(), range.place)) return;
    if (steps <= 0) {
      made_ += stanzas.size();
      for (const StanzaWalk& each : stanzas)
        noteEmptyRepeat(model_, each.scope, each.desc,
                        {each.declared, range.index, *first, *last, *step, range.place,
                         each.why.empty() && isEmptyByMistake(each.desc, range, *step)});
      return;
    }
    names.indices.push_back({range.index, 0});
    const auto goesOn = [&] { return !isOver(model_) && !std::ranges::all_of(stanzas, &StanzaWalk::failed); };
    for (std::int64_t i = *first; (*step > 0 ? i <= *last : i >= *last) && goesOn(); i += *step) {
      names.indices.back().value = static_cast<double>(i);
      repeat(stanzas, names);
    }
    names.indices.pop_back();
  }

  // ---- one instance ----

  // Whether there are not too many slots, and versions that they read.
  bool maySee(const StanzaWalk& stanza) {
    if (slotsMade_ + graph_.uses.size() + graph_.links.runs.size() <= text::raised(kMaxSlots)) return true;
    stopAt(
        model_, stanza.desc.place,
        fmt::format("with pass '{}' the graph has too many slots, parameters and defines", stanza.declared),
        kMaxSlots, "slots, parameters, defines and versions that are read, of all passes");
    return false;
  }

  // Why the instance is disabled; empty: it is not.
  std::string whyDisabled(const StanzaWalk& stanza, bool enabled) const {
    if (const auto rules = model_.disables.find(stanza.declared); rules != model_.disables.end())
      for (const DisableRule& rule : rules->second)
        if (rule.instance.empty() || rule.instance == name_) return rule.why;
    return stanza.why.empty() && !enabled ? whyFalse(stanza.desc.enabled) : stanza.why;
  }

  void instance(StanzaWalk& stanza, Names& names) {
    slotsMade_ += stanza.slots;
    if (!maySee(stanza)) return;
    const std::size_t before = model_.diagnostics.errorCount();
    std::vector<std::int64_t> at;
    for (const Names::Index& index : names.indices) at.push_back(static_cast<std::int64_t>(index.value));
    name_ = stanza.declared + (at.empty() ? "" : fmt::format("[{}]", fmt::join(at, ",")));
    const auto holds = evaluateCondition(names, stanza.desc.enabled, true, "'enabled'");
    if (!holds) {
      stanza.failed = true;
      return;
    }
    std::string why = whyDisabled(stanza, *holds);
    const bool enabled = why.empty();
    const SlotContext context{model_, names, stanza.type, {}, name_, enabled, *holds};
    const std::uint32_t pass = enabled ? static_cast<std::uint32_t>(graph_.passes.size()) : kNone;

    const std::size_t missed = model_.missing.size();
    slots_.clear();
    const SlotDesc* gone = nullptr;
    for (const SlotDesc& slot : stanza.desc.slots) {
      if (isOver(model_)) return;
      model_.slot = static_cast<std::uint32_t>(slots_.size());
      const State state = slots_.emplace_back(resolveSlot(context, slot, pass)).state;
      if (state == State::empty && !gone) gone = &slot;
    }
    model_.slot = kNone;
    firsts_.clear();
    for (std::size_t i = 0; i < stanza.desc.slots.size(); ++i)
      if (slots_[i].isConnected() && slots_[i].use.history > 0)
        if (SlotWork first = resolveFirst(context, slots_[i], pass, firsts_.emplace_back());
            first.isConnected()) {
          first.firstOf = i;
          slots_.push_back(std::move(first));
        }
    checkPassUses(context, stanza.desc, slots_);
    if (isOver(model_)) return;
    if (gone) model_.missing.resize(missed);  // nobody runs to miss it
    if (enabled && gone) why = fmt::format("'{}' is not there at this size", gone->ref.text);
    if (why.empty())
      emit(stanza, context);
    else
      disable(stanza, context, {name_, why, enabled && gone});
    if (model_.diagnostics.errorCount() > before && !names.indices.empty()) stanza.failed = true;
  }

  void disable(const StanzaWalk& stanza, const SlotContext& context, DisabledPass pass) {
    const auto index = static_cast<std::uint32_t>(graph_.disabled.size());
    graph_.disabled.push_back(std::move(pass));
    for (SlotWork& work : slots_) {
      work.use.keep = stanza.desc.sideEffect;  // for judge/culled.cpp
      if (work.isConnected() && work.reads())
        wouldUse(model_, {work});
      else if (work.isConnected())
        record(work, kNone, index);
    }
    if (!context.ranges || !stanza.sound) return;
    PassSpec ignored;
    std::vector<DeferredUniform> never;
    fillSpec(context, stanza.desc, slots_, ignored, kNone, never);
  }

  // ---- what goes into the graph ----

  void record(const SlotWork& work, std::uint32_t pass, std::uint32_t disabled) {
    // Whether a slot needs what another one writes: some pass must have written it before.
    const auto needs = [&](const SlotWork& other) {
      return other.slot->access != Access::write && other.use.history == 0 && other.overlaps(work);
    };
    model_.writes.push_back(
        {work, model_.position, pass, disabled, work.whole, std::ranges::any_of(slots_, needs)});
  }

  // The slot as the executor needs it, with its uses in element order. Reads and modifies take the current resource. False
  // when the graph has too many.
  bool emitSlot(const StanzaWalk& stanza, const SlotWork& work, std::uint32_t pass) {
    SlotSpec& slot = graph_.slots.emplace_back(SlotSpec{*work.slot});
    slot.kind = work.use.kind;
    slot.sampler = work.sampler;
    if (work.sampler.wrap == Wrap::border && work.border != BorderColor{}) {
      slot.border = static_cast<std::uint32_t>(graph_.borders.size());
      graph_.borders.push_back(work.border);
    }
    slot.array = work.array;
    slot.optional = work.slot->ref.optional;
    slot.firstUse = static_cast<std::uint32_t>(graph_.uses.size());
    const bool used = work.isConnected() || (work.state == State::missing && work.entity != kNone &&
                                             work.slot->access != Access::write);
    if (used && model_.entities[work.entity].state == Progress::done)
      for (std::uint32_t e = work.firstElement; e < work.firstElement + work.elementCount; ++e) {
        FlatUse use = work.use;
        use.feedback = stanza.desc.feedback && use.access == Access::modify;
        addUse(model_, work.entity, e, use, pass);
      }
    slot.useCount = static_cast<std::uint32_t>(graph_.uses.size()) - slot.firstUse;
    for (const SlotWork& first : slots_)
      if (slot.useCount > 0 && first.firstOf == static_cast<std::size_t>(&work - slots_.data())) {
        slot.firstValue = static_cast<std::uint32_t>(graph_.uses.size());
        addUse(model_, first.entity, first.firstElement, first.use, pass);
      }
    return maySee(stanza);
  }

  void emitWrites(const StanzaWalk& stanza, const SlotWork& work, const SlotSpec& spec, std::uint32_t pass) {
    for (std::uint32_t i = 0; i < work.elementCount; ++i) {
      const std::uint32_t e = work.firstElement + i, index = spec.firstUse + i;
      FlatUse& use = graph_.uses[index];
      if (use.access == Access::write)
        use.resource =
            resourceToWrite(model_, work.entity, e, work.whole, coversAll(stanza.type, stanza.desc, work));
      model_.versions.write(index);
    }
    record(work, pass, kNone);
  }

  void emit(const StanzaWalk& stanza, const SlotContext& context) {
    const PassDesc& desc = stanza.desc;
    const auto pass = static_cast<std::uint32_t>(graph_.passes.size());
    FlatPass flat;
    flat.cadence = desc.cadence;
    if (desc.cadence == Cadence::every)
      flat.period = static_cast<std::uint32_t>(
          evaluateWhole(context.names, desc.period, 1, 1, 65536, "n of every(n)").value_or(1));
    flat.sideEffect = desc.sideEffect;
    flat.touches = stanza.type->touches;
    flat.slices = static_cast<std::uint32_t>(
        evaluateWhole(context.names, desc.slices, 1, 0, 65536, "the number of slices").value_or(1));
    if (flat.slices > 1 && stanza.type->shader == ShaderShape::none)
      context.report(say::runsWhole, desc.slices.place(), desc.type);
    PassSpec spec{static_cast<const PassHead&>(desc), name_, stanza.declared};
    spec.firstSlot = static_cast<std::uint32_t>(graph_.slots.size());
    spec.slotCount = static_cast<std::uint32_t>(desc.slots.size());
    if (stanza.sound) fillSpec(context, desc, slots_, spec, pass, deferred_);
    flat.firstUse = static_cast<std::uint32_t>(graph_.uses.size());
    for (std::size_t i = 0; i < desc.slots.size(); ++i)
      if (!emitSlot(stanza, slots_[i], pass)) return;
    flat.useCount = static_cast<std::uint32_t>(graph_.uses.size()) - flat.firstUse;
    for (std::size_t i = 0; i < desc.slots.size(); ++i) {
      const SlotSpec& slot = graph_.slots[spec.firstSlot + i];
      if (slot.useCount == 0 || slot.access == Access::read) continue;
      if (slot.access == Access::modify && flat.cadence == Cadence::always)
        checkAccumulation(context, slots_[i], slot.firstUse);
      emitWrites(stanza, slots_[i], slot, pass);
    }
    graph_.passes.push_back(flat);
    graph_.passNames.push_back(name_);
    graph_.specs.push_back(std::move(spec));
    model_.positionOf.push_back(model_.position);
  }

  Model& model_;
  FlatGraph& graph_;
  std::vector<DeferredUniform>& deferred_;
  std::uint64_t made_ = 0, slotsMade_ = 0;  // passes, disabled ones and empty ranges counted; their slots
  // of the instance
  std::string name_;  // "glow_down[3]"
  std::vector<SlotWork> slots_;
  std::deque<SlotDesc> firsts_;
};

}  // namespace

void expandPasses(Model& model, std::vector<DeferredUniform>& deferred) {
  PassWalk(model, deferred).walk(model.scopes[0], {});
}

}  // namespace weft::graph::expansion
