#include "engine/graph/expand/passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "engine/base/limits.h"
#include "engine/base/nearest.h"
#include "engine/graph/expand/checks.h"
#include "engine/graph/expand/first_value.h"
#include "engine/graph/expand/names/unread.h"
#include "engine/graph/expand/names/versions.h"
#include "engine/graph/expand/spec.h"
#include "engine/graph/expand/stanza.h"

namespace weft::graph::expansion {

namespace {

// Why a pass whose "enabled" is false is disabled. Kept for each instance, so a long expression is cut.
std::string whyFalse(const Expr& enabled) {
  std::string text = enabled.text();
  if (enabled.isConstant()) return fmt::format("\"enabled\": {}", text);
  if (text.size() > 80) text = text.substr(0, 80) + "…";
  return fmt::format("enabled: {} is false", text);
}

using State = SlotWork::State;

// The slots, parameters and defines of one instance; a choice makes a define of each of its words.
std::uint64_t slotsOf(const PassDesc& desc) {
  std::uint64_t count = desc.slots.size() + desc.parameters.size() + desc.defines.size();
  for (const PassParameterDesc& parameter : desc.parameters)
    if (parameter.declared) count += parameter.declared->choices.size();
  return count;
}

class PassWalk {
 public:
  PassWalk(Model& model, std::vector<DeferredUniform>& deferred)
      : model_(model), graph_(model.graph), deferred_(deferred) {}

  void walk(Scope& scope, const std::string& outerWhy) {
    const std::string& why = outerWhy.empty() ? scope.disabledBy : outerWhy;
    for (const PassDesc& desc : scope.desc->passes) {
      if (isOver(model_)) return;
      if (desc.include)
        walkInclude(scope, desc, why);
      else if (scope.passes.find(desc.name)->second == &desc)
        walkStanza(scope, desc, why);
    }
  }

 private:
  void walkInclude(Scope& scope, const PassDesc& desc, const std::string& why) {
    const auto child = scope.includes.find(desc.include->as);
    if (child == scope.includes.end() || child->second->stanza != &desc) return;
    checkExpr(model_, scope, desc.enabled);
    markStructural(model_, scope, desc.enabled);
    Names names(model_, scope);
    const auto enabled = evaluateCondition(names, desc.enabled, true, "'enabled' of an include");
    model_.incomplete = model_.incomplete || !enabled;  // nobody knows whether its passes are there
    if (enabled) walk(*child->second, why.empty() && !*enabled ? whyFalse(desc.enabled) : why);
  }

  // ---- one stanza: its repeats ----

  void walkStanza(Scope& scope, const PassDesc& desc, const std::string& why) {
    scope_ = &scope;
    desc_ = &desc;
    declared_ = scope.prefix + desc.name;
    scopeWhy_ = why;
    type_ = findPassType(model_.registry, desc.type);
    const auto rules = model_.disables.find(declared_);
    rules_ = rules == model_.disables.end() ? nullptr : &rules->second;
    failed_ = false;
    slotsOfInstance_ = slotsOf(desc);
    if (slotsOfInstance_ > base::raised(kMostSlotsOfPass))
      return stopAt(model_, desc.place,
                    fmt::format("pass '{}' has too many slots, parameters and defines", declared_),
                    kMostSlotsOfPass, "slots, parameters and defines of one pass");
    stanzaGood_ = checkStanza(model_, scope, desc, type_, declared_);
    if (!type_) type_ = typeMeantBy(desc.type);  // so that nothing else is reported because of it
    Names names(model_, scope);
    repeat(names, 0);
    if (!failed_ && stanzaGood_) return;
    for (const SlotDesc& slot : desc.slots)
      if (slot.access != Access::read) leaveOutWrite(model_, scope, slot.ref);
  }

  const PassType* typeMeantBy(const std::string& name) const {
    std::vector<std::string> types;
    for (const PassType& known : model_.registry.passTypes) types.push_back(known.name);
    return findPassType(model_.registry, base::nearestName(name, types));
  }

  // Whether `more` passes may follow; reports otherwise.
  bool mayMake(std::uint64_t more, const Place& place) {
    if (made_ + more <= base::raised(kMostPasses)) return true;
    auto& d = model_.diagnostics.error(Code::tooManyPasses, place,
                                       fmt::format("with pass '{}' the graph has more than {} passes",
                                                   declared_, base::raised(kMostPasses)));
    d.pass = declared_;
    d.hint = base::hintToRaise(kMostPasses, made_ + more);
    if (d.hint.empty()) d.hint = "let one compute pass have more threads";
    model_.stopped = model_.incomplete = true;
    return false;
  }

  void repeat(Names& names, std::size_t depth) {
    if (depth == desc_->repeat.size()) {
      if (!mayMake(1, desc_->place)) return;
      ++made_;
      instance(names);
      ++model_.position;
      return;
    }
    const RangeDesc& range = desc_->repeat[depth];
    constexpr std::int64_t kFar = 1'000'000'000;
    const auto first = evaluateWhole(names, range.first, 0, -kFar, kFar, "a bound of a repeat");
    const auto last = evaluateWhole(names, range.last, 0, -kFar, kFar, "a bound of a repeat");
    const auto step = evaluateWhole(names, range.step, 1, -kFar, kFar, "the step of a repeat");
    if (!first || !last || !step || *step == 0) {
      if (step && *step == 0)
        model_.diagnostics
            .error(Code::numberOutOfRange, range.place,
                   fmt::format("pass '{}' repeats '{}' in steps of 0", declared_, range.index))
            .expected = "a step that leads from the first to the last index";
      failed_ = true;
      return;
    }
    const std::int64_t steps = (*last - *first) / *step + 1;
    // Each step makes a pass, or ends at an empty range within.
    if (!mayMake(static_cast<std::uint64_t>(std::max<std::int64_t>(steps, 1)), range.place)) return;
    if (steps <= 0) {
      ++made_;
      noteEmptyRepeat(model_, *scope_, *desc_, range,
                      {declared_, range.index, *first, *last, *step, range.place, scopeWhy_.empty()});
      return;
    }
    names.indices.push_back({range.index, 0});
    for (std::int64_t i = *first; (*step > 0 ? i <= *last : i >= *last) && !failed_ && !isOver(model_);
         i += *step) {
      names.indices.back().value = static_cast<double>(i);
      repeat(names, depth + 1);
    }
    names.indices.pop_back();
  }

  // name_ and user_ of the instance.
  void nameInstance(const Names& names) {
    name_ = declared_;
    for (std::size_t i = 0; i < names.indices.size(); ++i)
      fmt::format_to(std::back_inserter(name_), "{}{}", i ? "," : "[",
                     static_cast<std::int64_t>(names.indices[i].value));
    if (!names.indices.empty()) name_ += "]";
    user_.assign("pass '").append(name_).append("'");
  }

  // ---- one instance ----

  // Whether there are not too many slots, and versions that they read.
  bool maySee() {
    if (slotsMade_ + graph_.uses.size() + graph_.links.runs.size() <= base::raised(kMostSlots)) return true;
    stopAt(model_, desc_->place,
           fmt::format("with pass '{}' the graph has too many slots, parameters and defines", declared_),
           kMostSlots, "slots, parameters, defines and versions that are read, of all passes");
    return false;
  }

  // Why it is disabled; empty: it is not. nullopt after a report.
  std::optional<std::string> whyDisabled(Names& names, const std::string& name, bool& byItself) {
    const auto enabled = evaluateCondition(names, desc_->enabled, true, "'enabled'");
    if (!enabled) return std::nullopt;
    byItself = !*enabled;
    if (rules_)
      for (const DisableRule& rule : *rules_)
        if (rule.instance.empty() || rule.instance == name) return rule.why;
    if (!scopeWhy_.empty()) return scopeWhy_;
    if (!*enabled) return whyFalse(desc_->enabled);
    return std::string();
  }

  void instance(Names& names) {
    slotsMade_ += slotsOfInstance_;
    if (!maySee()) return;
    const std::size_t before = model_.diagnostics.errorCount();
    nameInstance(names);
    bool byItself = false;
    const auto why = whyDisabled(names, name_, byItself);
    if (!why) {
      failed_ = true;
      return;
    }
    const bool enabled = why->empty();
    const SlotContext context{model_, names, type_, user_, name_, enabled, !byItself, &leaves_};
    const auto pass = static_cast<std::uint32_t>(graph_.passes.size());

    const std::size_t missed = model_.missing.size();
    std::vector<SlotWork>& slots = slots_;
    slots.clear();
    const SlotDesc* gone = nullptr;
    for (const SlotDesc& slot : desc_->slots) {
      if (isOver(model_)) return;
      model_.slot = static_cast<std::uint32_t>(slots.size());
      slots.push_back(resolveSlot(context, slot, enabled ? pass : kNone));
      if (slots.back().state == State::empty && !gone) gone = &slot;
      if (slots.back().state == State::failed && slot.access != Access::read)
        leaveOutWrite(model_, *scope_, slot.ref);
    }
    model_.slot = kNone;
    firsts_.resolve(context, slots, enabled ? pass : kNone);
    const std::vector<SlotWork>& all = firsts_.with(slots);
    checkPassUses(context, *desc_, all);
    if (isOver(model_)) return;
    if (gone) model_.missing.resize(missed);  // nobody runs to miss it
    const std::string off =
        enabled && gone ? fmt::format("'{}' is not there at this size", gone->ref.text) : *why;
    if (off.empty())
      emit(context, slots, names);
    else
      disabledInstance(context, all, off);
    // The other repeats would say the same.
    if (model_.diagnostics.errorCount() > before && !names.indices.empty()) failed_ = true;
  }

  void disabledInstance(const SlotContext& context, const std::vector<SlotWork>& slots,
                        const std::string& why) {
    const auto index = static_cast<std::uint32_t>(graph_.disabled.size());
    graph_.disabled.push_back({name_, why});
    if (desc_->sideEffect) wouldUse(model_, WouldUse{});
    for (const SlotWork& work : slots)
      if (work.state == State::empty && work.slot->access != Access::read)
        wouldUse(model_, WouldUse{});  // who knows what reads it at another size
      else if (work.state == State::connected && work.slot->access == Access::read)
        wouldUse(model_, {WouldUse::Why::off, work.entity, work.firstElement, work.elementCount, work.use});
      else if (work.state == State::connected)
        record(slots, work, kNone, index);
    if (!context.ranges || !stanzaGood_) return;
    PassSpec ignored;
    values_.clear();
    fillSpec(context, *desc_, slots, ignored, values_);
  }

  // ---- what goes into the graph ----

  void record(const std::vector<SlotWork>& slots, const SlotWork& work, std::uint32_t pass,
              std::uint32_t disabled) {
    model_.writes.push_back({work.entity, work.firstElement, work.elementCount, work.use, model_.position,
                             pass, disabled, work.whole,
                             std::ranges::any_of(slots, [&](const auto& o) { return needs(o, work); })});
  }

  std::uint32_t groupOf() {
    std::string name = desc_->group.empty() ? std::string() : scope_->prefix + desc_->group;
    if (name.empty() && desc_->cadence != Cadence::always) name = scope_->group;
    if (name.empty()) return kNone;
    const auto [at, fresh] = groups_.try_emplace(name, static_cast<std::uint32_t>(graph_.groupNames.size()));
    if (fresh) graph_.groupNames.push_back(name);
    return at->second;
  }

  void addCadence(const SlotContext& context, Names& names, FlatPass& flat) {
    flat.cadence = desc_->cadence;
    flat.sideEffect = desc_->sideEffect;
    if (type_) flat.touches = type_->touches;
    flat.group = groupOf();
    const auto slices = evaluateWhole(names, desc_->slices, 1, 0, 65536, "the number of slices");
    if (!slices) return;
    flat.slices = static_cast<std::uint32_t>(*slices);
    if (flat.slices > 1 && type_ && type_->shader == ShaderShape::none) {
      auto& d =
          model_.diagnostics.error(Code::badSlices, desc_->slices.place(),
                                   fmt::format("{} is a {}, which runs whole", context.user, desc_->type));
      d.pass = context.pass;
      d.hint = "remove \"slices\": the pass takes one frame of its group";
    }
    if (flat.slices > 0 || flat.group != kNone) return;
    auto& d = model_.diagnostics.error(
        Code::badSlices, desc_->slices.place(),
        fmt::format("{} has no slices of its own and no group to ride with", context.user));
    d.pass = context.pass;
    d.hint = "0 slices go with a \"group\": the pass runs with its predecessor";
  }

  // Uses of one slot, in element order. Reads and modifies take the current resource.
  void emitUses(const SlotWork& work, std::uint32_t pass) {
    for (std::uint32_t e = work.firstElement; e < work.firstElement + work.elementCount; ++e) {
      FlatUse use = work.use;
      use.feedback = desc_->feedback && use.access == Access::modify;
      use.exact = type_ && type_->exactCopies;  // finishGraph() looks at the shapes
      addUse(model_, work.entity, e, use, pass);
    }
  }

  void emitWrites(const std::vector<SlotWork>& slots, const SlotWork& work, const SlotSpec& spec,
                  std::uint32_t pass) {
    for (std::uint32_t i = 0; i < work.elementCount; ++i) {
      const std::uint32_t e = work.firstElement + i, index = spec.firstUse + i;
      FlatUse& use = graph_.uses[index];
      if (use.access == Access::write)
        use.resource = resourceToWrite(model_, work.entity, e, work.whole, coversAll(type_, work));
      model_.versions.write(index);
    }
    record(slots, work, pass, kNone);
  }

  // The slot as the executor needs it, with its uses. False when the graph has too many.
  bool emitSlot(const SlotWork& work, std::uint32_t pass) {
    SlotSpec& slot = graph_.slots.emplace_back();
    slot.name = work.slot->name;
    slot.access = work.slot->access;
    slot.kind = work.use.kind;
    slot.sampler = work.sampler;
    if (work.sampler.wrap == Wrap::border && work.border != BorderColor{}) {
      slot.border = static_cast<std::uint32_t>(graph_.borders.size());
      graph_.borders.push_back(work.border);
    }
    slot.array = work.array;
    slot.optional = work.slot->ref.optional;
    slot.place = work.slot->place;
    slot.inherited = base::isSamePlace(slot.place, desc_->likePlace);
    slot.firstUse = static_cast<std::uint32_t>(graph_.uses.size());
    const bool used =
        work.state == State::connected ||
        (work.state == State::missing && work.entity != kNone && work.slot->access != Access::write);
    if (used && model_.entities[work.entity].state == Progress::done) emitUses(work, pass);
    slot.useCount = static_cast<std::uint32_t>(graph_.uses.size()) - slot.firstUse;
    if (slot.useCount > 0) firsts_.emit(model_, work, pass, slot);
    return maySee();
  }

  void emit(const SlotContext& context, const std::vector<SlotWork>& slots, Names& names) {
    const auto pass = static_cast<std::uint32_t>(graph_.passes.size());
    FlatPass flat;
    addCadence(context, names, flat);
    PassSpec spec{.name = name_,
                  .declared = declared_,
                  .type = desc_->type,
                  .shader = desc_->shader,
                  .vertexShader = desc_->vertexShader,
                  .place = desc_->place,
                  .shaderPlace = desc_->shaderPlace,
                  .firstSlot = static_cast<std::uint32_t>(graph_.slots.size()),
                  .slotCount = static_cast<std::uint32_t>(slots.size())};
    values_.clear();
    if (stanzaGood_) fillSpec(context, *desc_, slots, spec, values_);
    flat.firstUse = static_cast<std::uint32_t>(graph_.uses.size());
    for (const SlotWork& work : slots)
      if (!emitSlot(work, pass)) return;
    flat.useCount = static_cast<std::uint32_t>(graph_.uses.size()) - flat.firstUse;
    for (std::size_t i = 0; i < slots.size(); ++i) {
      const SlotSpec& slot = graph_.slots[spec.firstSlot + i];
      if (slot.useCount == 0 || slot.access == Access::read) continue;
      if (slot.access == Access::modify && flat.cadence == Cadence::always)
        checkAccumulation(context, slots[i], slot.firstUse);
      emitWrites(slots, slots[i], slot, pass);
    }
    for (const DeferredValue& value : values_) deferred_.push_back({pass, value, scope_, names.indices});
    graph_.passes.push_back(flat);
    graph_.passNames.push_back(name_);
    graph_.specs.push_back(std::move(spec));
    model_.positionOf.push_back(model_.position);
  }

  Model& model_;
  FlatGraph& graph_;
  std::vector<DeferredUniform>& deferred_;
  NameMap<std::uint32_t> groups_;
  std::uint64_t made_ = 0, slotsMade_ = 0;  // passes, disabled ones and empty ranges counted; their slots
  // of the stanza
  Scope* scope_ = nullptr;
  const PassDesc* desc_ = nullptr;
  const PassType* type_ = nullptr;
  const std::vector<DisableRule>* rules_ = nullptr;
  std::string declared_, scopeWhy_;
  std::uint64_t slotsOfInstance_ = 0;
  bool failed_ = false, stanzaGood_ = true;
  // of the instance; kept from one to the next for their memory
  std::string name_, user_;  // "glow_down[3]", "pass 'glow_down[3]'"
  std::vector<SlotWork> slots_;
  FirstValues firsts_;
  std::vector<DeferredValue> values_;
  std::vector<Leaf> leaves_;
};

}  // namespace

void expandPasses(Model& model, std::vector<DeferredUniform>& deferred) {
  // Of stanzas that do not repeat: a large graph of them is not copied while it grows.
  std::size_t slots = 0, passes = 0, values = 0;
  for (const Scope& scope : model.scopes) {
    passes += scope.desc->passes.size();
    for (const PassDesc& pass : scope.desc->passes) {
      slots += pass.slots.size();
      values += pass.parameters.size();
    }
  }
  model.graph.slots.reserve(slots);
  model.graph.uses.reserve(slots);
  model.graph.passes.reserve(passes);
  model.graph.passNames.reserve(passes);
  model.graph.specs.reserve(passes);
  deferred.reserve(values);
  PassWalk(model, deferred).walk(model.scopes[0], {});
}

}  // namespace weft::graph::expansion
