#include "engine/graph/expand/slots.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/graph/expand/checks.h"
#include "engine/graph/expand/names/versions.h"

namespace weft::graph::expansion {

namespace {

using base::Diagnostic;
using State = SlotWork::State;

Diagnostic& report(const SlotContext& context, Code code, const Place& place, std::string message,
                   const std::string& resource) {
  Diagnostic& d = context.model.diagnostics.error(code, place, std::move(message));
  d.pass = context.pass;
  d.resource = resource;
  return d;
}

// Further out than any limit; ranges are checked against shapes later.
constexpr std::int64_t kFar = 1'000'000;

std::optional<Selection::Span> evaluateSpan(Names& names, const SpanDesc& desc, const char* word) {
  const auto first = evaluateWhole(names, desc.first, 0, -kFar, kFar, word);
  const auto last = evaluateWhole(names, desc.last, 0, -kFar, kFar, word);
  if (!first || !last) return std::nullopt;
  return Selection::Span{*first, desc.range ? *last : *first, desc.range && !desc.first.present(),
                         desc.range && !desc.last.present(),
                         desc.first.present() ? desc.first.place() : desc.last.place()};
}

// Adds the selectors of `ref` to what is selected already (from outside: a slot that selects in an alternative).
bool addSelection(const SlotContext& context, Names& names, const RefDesc& ref, Selection& into) {
  const auto add = [&](std::optional<Selection::Span>& selected, const SpanDesc& said, const char* word) {
    const auto span = evaluateSpan(names, said, word);
    if (!span) return false;
    if (selected) {
      auto& d = report(context, Code::badSelector, ref.place,
                       fmt::format("{} selects twice in '{}'", context.user, ref.text), ref.name);
      d.hint = "the list of alternatives selects this already";
      return false;
    }
    selected = span;
    return true;
  };
  into.stencil = into.stencil || ref.stencil;
  return (!ref.mip || add(into.mip, *ref.mip, "the level")) &&
         (!ref.layer || add(into.layer, *ref.layer, "the layer")) &&
         (!ref.face || add(into.face, *ref.face, "the face")) &&
         (!ref.element || add(into.element, {.first = *ref.element}, "the element"));
}

bool selectorMisfit(const SlotContext& context, const RefDesc& ref, const Entity& entity, std::string message,
                    std::string hint) {
  message = fmt::format("{}: {}", context.user, message);
  auto& d = report(context, Code::badSelector, ref.place, std::move(message), entity.name);
  d.found = ref.text;
  d.hint = hint.empty() ? "leave the selector out, or name a resource that has such parts" : std::move(hint);
  return false;
}

// A kind of part of a resource: its word, how many there are, and as the file says: levels between the two were removed by the
// clamp to the size.
struct Extent {
  const char* word;
  std::int64_t count, written;
  bool levels = false;
};
struct Range {
  std::int64_t first = 0, size = 1;
  bool empty = false;  // nothing of the span is there at this size
};

// Fills open ends and holds a span against what there is; all of it without a span. nullopt after a report.
std::optional<Range> closeSpan(const SlotContext& context, const RefDesc& ref, const Entity& entity,
                               const Extent& extent, const std::optional<Selection::Span>& said) {
  const auto& [word, count, written, levels] = extent;
  if (!said) return Range{0, count};
  const std::int64_t first = said->openFirst ? 0 : said->first;
  std::int64_t last = said->openLast ? count - 1 : said->last;
  const bool clamped = first >= 0 && first < written && last >= first && last < written;
  if (clamped) last = std::min(last, count - 1);
  const std::int64_t size = last - first + 1;
  const bool nothingLeft =
      clamped ? first >= count : said->openLast && first >= count && first <= std::max(count, written);
  const bool there = first >= 0 && last < count && size >= 1;
  if (nothingLeft || (!context.ranges && !there)) return Range{.empty = true};
  if (there) return Range{first, size};
  auto& d = report(
      context, Code::missingSubresource, said->place.line ? said->place : ref.place,
      fmt::format("{} uses {} {} of '{}', which is not there", context.user, word,
                  first == last ? fmt::format("{}", first) : fmt::format("{}..{}", first, last), entity.name),
      entity.name);
  d.expected =
      count == 1 ? fmt::format("{} 0, the only one", word) : fmt::format("{} 0 to {}", word, count - 1);
  d.found = ref.text;
  if (levels)
    d.hint =
        fmt::format("\"mips\" says how many levels there are; bounds can be written with mips({})", ref.name);
  return std::nullopt;
}

// All concrete candidates of a reference whose conditions hold, in order. False after a report.
bool collectLeaves(const SlotContext& context, Names& names, const RefDesc& ref, const Leaf& outer,
                   std::vector<Leaf>& leaves) {
  Model& model = context.model;
  Leaf leaf = outer;
  leaf.entity = findEntityOrReport(model, names.scope(), ref.name, ref.import, ref.place,
                                   {context.user, "uses", context.pass});
  if (leaf.entity == kNone) return false;
  if (!addSelection(context, names, ref, leaf.selection)) return false;
  if (!leaf.kind) leaf.kind = ref.kind;
  if (leaf.sampler.wrap == Wrap::clamp) leaf.border = ref.border;
  leaf.sampler = layOver(leaf.sampler, ref.sampler);
  leaf.history += ref.history;
  Entity& entity = model.entities[leaf.entity];
  entity.read = true;
  entity.firstRead = std::min(entity.firstRead, model.position);
  if (entity.kind != ResourceDesc::Kind::alternatives) {
    leaves.push_back(std::move(leaf));
    return true;
  }
  if (entity.listState == Progress::failed) return false;  // reported
  Names listNames(model, *entity.scope);
  bool good = true;
  for (std::size_t i = 0; i < entity.candidates.size(); ++i) {
    if (entity.candidates[i] == kNone) continue;
    const RefDesc& alternative = entity.desc->alternatives[i];
    const auto holds =
        evaluateCondition(listNames, alternative.condition, true, "the condition of an alternative");
    if (!holds) good = false;
    if (holds && !*holds)
      wouldUse(model, entity.candidates[i], Access::read, leaf.history + alternative.history);
    Leaf within = leaf;
    within.conditional = leaf.conditional || alternative.condition.present();
    if (holds && *holds) good = collectLeaves(context, listNames, alternative, within, leaves) && good;
  }
  return good;
}

// The selected rectangle of a leaf, checked. `work` gets entity, elements, use (without kind), whole, and the state `empty`
// when none of the levels is there at this size. False after a report.
bool placeSelection(const SlotContext& context, const Leaf& leaf, const RefDesc& ref, SlotWork& work) {
  Model& model = context.model;
  work.entity = leaf.entity;
  if (!ensureShape(model, leaf.entity)) return false;
  const Entity& entity = model.entities[leaf.entity];
  const FlatResource& shape = entity.shape;
  const Selection& selection = leaf.selection;
  const bool texture = isTexture(shape), cube = isCube(shape);
  const auto misfit = [&](std::string message, std::string hint = {}) {
    return selectorMisfit(context, ref, entity, fmt::format("'{}' {}", entity.name, message),
                          std::move(hint));
  };
  if (!texture && (selection.mip || selection.layer || selection.face || selection.stencil))
    return misfit("is no texture, it has no levels, layers or planes");
  if (selection.element && entity.arrayCount == 0)
    return misfit("is no array", selection.element->first < 0
                                     ? fmt::format("write '{}@{}' for an earlier frame", entity.name,
                                                   selection.element->first)
                                     : fmt::format("a level is '{}.mip[…]'", entity.name));
  if (selection.layer && shape.target == Target::texture_3d)
    return misfit("is a 3d texture, it has no layers");
  if (selection.face && !cube) return misfit("is no cube, it has no faces");
  if (selection.stencil && !hasStencil(shape.format))
    return misfit(
        fmt::format("({}) has no stencil", infoOf(shape.format).name),
        isDepth(shape.format) ? "formats with a stencil are depth24_stencil8 and depth32f_stencil8" : "");

  const auto close = [&](const char* word, std::uint32_t count, const std::optional<Selection::Span>& said) {
    return closeSpan(context, ref, entity, {word, count, count}, said);
  };
  const std::uint32_t layerCount = cube ? shape.layers / 6 : shape.layers;
  const auto mips =
      closeSpan(context, ref, entity, {"level", shape.mips, entity.writtenMips, true}, selection.mip);
  if (!mips) return false;
  auto layers = close("layer", layerCount, selection.layer);
  if (!layers) return false;
  if (cube) {
    const auto faces = close("face", 6, selection.face);
    if (!faces) return false;
    if (faces->size < 6 && layers->size > 1)
      return misfit("has faces of several cubes, which are not next to each other");
    layers = Range{layers->first * 6 + faces->first, faces->size < 6 ? faces->size : layers->size * 6,
                   layers->empty || faces->empty};
  }
  const auto elements = close("element", entity.arrayCount, selection.element);
  if (!elements) return false;
  work.array = entity.arrayCount > 0 && !selection.element;
  work.firstElement = static_cast<std::uint32_t>(elements->first);
  work.elementCount = static_cast<std::uint32_t>(std::max<std::int64_t>(1, elements->size));
  work.whole = !selection.mip && !selection.layer && !selection.face && !selection.stencil;
  work.use.mip = static_cast<std::uint16_t>(mips->first);
  work.use.mips = static_cast<std::uint16_t>(mips->size);
  work.use.layer = static_cast<std::uint16_t>(layers->first);
  work.use.layers = static_cast<std::uint16_t>(layers->size);
  work.use.planes = selection.stencil ? 2 : planeMask(shape);
  work.sampler = leaf.sampler;
  work.border = leaf.border;
  work.state = mips->empty || layers->empty || elements->empty ? State::empty : State::connected;
  return true;
}

// Kind and planes, once the rectangle is known.
bool finishUse(const SlotContext& context, const Leaf& leaf, const RefDesc& ref, Access access,
               SlotWork& work) {
  const FlatResource& shape = context.model.entities[work.entity].shape;
  work.use.access = access;
  work.use.kind = leaf.kind.value_or(defaultKind(context.type, access, shape));
  if (work.sampler.compare) work.sampler.linear = true;
  const bool shaderRead = work.use.kind == Kind::sampled || work.use.kind == Kind::image;
  if (shaderRead && work.use.planes == 3) work.use.planes = 1;  // a shader sees depth unless .stencil is said
  return checkUse(context, ref, access, work);
}

bool isWritable(const SlotContext& context, const SlotDesc& slot, std::uint32_t found) {
  const Entity& entity = context.model.entities[found];
  const char* why = nullptr;
  std::string hint;
  if (slot.ref.history > 0) {
    why = "an earlier publication";
    hint = "write the resource without @-n";
  } else if (entity.kind == ResourceDesc::Kind::import) {
    why = "an import";
    hint = "write a texture or buffer of the graph's own";
  } else if (entity.kind == ResourceDesc::Kind::alternatives) {
    why = "a list of alternatives";
    hint = "write one of those it lists";
  } else {
    return true;
  }
  auto& d = report(context, Code::notWritable, slot.ref.place,
                   fmt::format("{} {} '{}', which is {} and cannot be written", context.user,
                               slot.access == Access::write ? "writes" : "modifies", slot.ref.text, why),
                   entity.name);
  d.hint = hint;
  return false;
}

void noteWould(Model& model, const SlotWork& work, WouldUse::Why why) {
  wouldUse(model, {why, work.entity, work.firstElement, work.elementCount, work.use});
}

// A slot whose condition, or that of each of its alternatives, may leave it without a resource.
class SlotChoice {
 public:
  // `context`: of the slot. `pass`: whose it is, for what is missing.
  SlotChoice(const SlotContext& context, const SlotDesc& slot, std::uint32_t pass,
             const std::vector<Leaf>& leaves)
      : context_(context), model_(context.model), slot_(slot), pass_(pass), leaves_(leaves) {}

  // Its condition is false.
  SlotWork off() {
    SlotWork work = none(State::failed);
    if (!leaves_.empty()) {
      if (!place(leaves_[0], work)) return none(State::failed);
      const bool placed = work.state == State::connected;
      if (placed && context_.versions) noteWould(model_, work, WouldUse::Why::off);
      if (context_.versions) noteOthers(placed ? 1 : 0);
    }
    work.state = slot_.access == Access::read && !slot_.ref.optional ? State::missing : State::absent;
    if (work.state == State::missing) addMissing(MissingRead::Cause::condition);
    return work;
  }

  // The first alternative that has a version, or the first with no more than version zero, or nothing.
  SlotWork choose() {
    bool onlyImports = !leaves_.empty(), byCondition = false;
    std::optional<SlotWork> zero, first;
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
      SlotWork work = none(State::failed);
      if (!place(leaves_[i], work)) return none(State::failed);
      if (work.state == State::empty) {
        if (slot_.ref.optional) work.state = State::absent;
        return work;
      }
      const bool import = model_.entities[work.entity].kind == ResourceDesc::Kind::import;
      const bool asks = context_.versions && slot_.access != Access::write && work.use.history == 0;
      const VersionCheck found = asks ? versionsOf(work) : VersionCheck{.real = true};
      // Those behind one that is there by a condition, or from outside, are off as long as it is.
      byCondition = byCondition || leaves_[i].conditional || import;
      if (found.complete && found.real) {
        if (byCondition || !context_.versions) noteOthers(i + 1);
        return work;
      }
      onlyImports = onlyImports && import;
      if (slot_.access == Access::read)
        noteWould(model_, work,
                  found.complete && !slot_.ref.optional ? WouldUse::Why::zero : WouldUse::Why::empty);
      if (found.complete && !zero) zero = work;
      if (!first) first = std::move(work);
    }
    if (zero && !slot_.ref.optional) return *zero;
    SlotWork work = first.value_or(none(State::failed));
    work.state = slot_.ref.optional || !context_.versions ? State::absent : State::missing;
    if (work.state == State::missing)
      addMissing(leaves_.empty() ? MissingRead::Cause::condition
                 : onlyImports   ? MissingRead::Cause::import
                                 : MissingRead::Cause::version);
    return work;
  }

 private:
  SlotWork none(State state) const {
    SlotWork work;
    work.slot = &slot_;
    work.state = state;
    work.use.access = slot_.access;
    return work;
  }

  bool place(const Leaf& leaf, SlotWork& work) const {
    if (!placeSelection(context_, leaf, slot_.ref, work) ||
        !finishUse(context_, leaf, slot_.ref, slot_.access, work))
      return false;
    work.use.history = static_cast<std::uint8_t>(leaf.history);
    return leaf.history == 0 || checkHistory(context_, slot_.ref, leaf.history, model_.entities[work.entity]);
  }

  // Of all elements together. Notes what is not there.
  VersionCheck versionsOf(const SlotWork& work) {
    VersionCheck all;
    for (std::uint32_t e = work.firstElement; e < work.firstElement + work.elementCount; ++e) {
      const VersionCheck check = checkVersion(model_, work.entity, e, work.use);
      all.real = all.real || check.real;
      if (all.complete && !check.complete) wanted_.push_back({work.entity, e, check.missing, work.use});
      all.complete = all.complete && check.complete;
    }
    return all;
  }

  // The alternatives from `first` on, which are off.
  void noteOthers(std::size_t first) const {
    for (std::size_t i = first; i < leaves_.size(); ++i)
      wouldUse(model_, leaves_[i].entity, slot_.access, leaves_[i].history);
  }

  void addMissing(MissingRead::Cause cause) {
    if (context_.versions)
      model_.missing.push_back(
          {cause, pass_, model_.position, slot_.name, slot_.ref, false, slot_.access, std::move(wanted_)});
  }

  const SlotContext& context_;
  Model& model_;
  const SlotDesc& slot_;
  const std::uint32_t pass_;
  const std::vector<Leaf>& leaves_;
  std::vector<MissingRead::Wanted> wanted_;
};

}  // namespace

SlotWork resolveSlot(const SlotContext& context, const SlotDesc& slot, std::uint32_t pass) {
  const RefDesc& ref = slot.ref;
  SlotWork failed;
  failed.slot = &slot;
  failed.use.access = slot.access;
  const char* const verb = slot.access == Access::read    ? "reads"
                           : slot.access == Access::write ? "writes"
                                                          : "modifies";
  const std::uint32_t found = findEntityOrReport(context.model, context.names.scope(), ref.name, ref.import,
                                                 ref.place, {context.user, verb, context.pass, slot.name});
  if (found == kNone || (slot.access != Access::read && !isWritable(context, slot, found))) return failed;
  const auto holds = evaluateCondition(context.names, ref.condition, true, "the condition of a slot");
  if (!holds) return failed;
  // A slot whose condition is false may select what is not there; the rest of it must make sense all the same.
  SlotContext checked = context;
  checked.ranges = checked.ranges && *holds;
  std::vector<Leaf> own;
  std::vector<Leaf>& leaves = context.room ? *context.room : own;
  leaves.clear();
  if (!collectLeaves(checked, context.names, ref, Leaf{}, leaves)) return failed;
  SlotChoice choice(checked, slot, pass, leaves);
  return *holds ? choice.choose() : choice.off();
}

}  // namespace weft::graph::expansion
