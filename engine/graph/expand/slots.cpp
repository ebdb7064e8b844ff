#include "engine/graph/expand/slots.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/graph/expand/checks.h"
#include "engine/graph/expand/judge/remedy.h"
#include "engine/graph/expand/names/limits.h"
#include "engine/graph/expand/names/versions.h"

namespace weft::graph::expansion {

namespace {

using base::Diagnostic;

Diagnostic& report(const SlotContext& context, Code code, const Place& place, std::string message,
                   const std::string& resource) {
  Diagnostic& d = context.model.diagnostics.error(code, place, std::move(message));
  d.pass = context.pass;
  d.resource = resource;
  return d;
}

// Further out than any limit; ranges are checked against shapes later.
constexpr std::int64_t kFar = 1'000'000;

bool evaluateSpan(Names& names, const SpanDesc& desc, const char* word, std::optional<Selection::Span>& out) {
  Selection::Span span;
  span.openFirst = desc.range && !desc.first.present();
  span.openLast = desc.range && !desc.last.present();
  const auto first = evaluateWhole(names, desc.first, 0, -kFar, kFar, word);
  const auto last = evaluateWhole(names, desc.last, 0, -kFar, kFar, word);
  if (!first || !last) return false;
  span.first = *first, span.last = desc.range ? *last : *first;
  span.place = desc.first.present() ? desc.first.place() : desc.last.place();
  out = span;
  return true;
}

// Adds the selectors of `ref` to what is selected already (from outside: a slot that selects in an alternative).
bool addSelection(const SlotContext& context, Names& names, const RefDesc& ref, Selection& into) {
  Selection own;
  if (ref.mip && !evaluateSpan(names, *ref.mip, "the level", own.mip)) return false;
  if (ref.layer && !evaluateSpan(names, *ref.layer, "the layer", own.layer)) return false;
  if (ref.face && !evaluateSpan(names, *ref.face, "the face", own.face)) return false;
  if (ref.element) {
    const auto element = evaluateWhole(names, *ref.element, 0, -kFar, kFar, "the element");
    if (!element) return false;
    own.element = *element;
  }
  const bool clash = (own.mip && into.mip) || (own.layer && into.layer) || (own.face && into.face) ||
                     (own.element && into.element) || (own.stencil && into.stencil);
  if (clash) {
    auto& d = report(context, Code::badSelector, ref.place,
                     fmt::format("{} selects twice in '{}'", context.user, ref.text), ref.name);
    d.hint = "the list of alternatives selects this already";
    return false;
  }
  if (own.mip) into.mip = own.mip;
  if (own.layer) into.layer = own.layer;
  if (own.face) into.face = own.face;
  if (own.element) {
    into.element = own.element;
    into.elementPlace = ref.element->place();
  }
  into.stencil = into.stencil || ref.stencil;
  return true;
}

bool selectorMisfit(const SlotContext& context, const RefDesc& ref, const Entity& entity, std::string message,
                    std::string hint) {
  message = fmt::format("{}: {}", context.user, message);
  auto& d = report(context, Code::badSelector, ref.place, std::move(message), entity.name);
  d.found = ref.text;
  d.hint = hint.empty() ? "leave the selector out, or name a resource that has such parts" : std::move(hint);
  return false;
}

// Fills open ends and holds a span against `count`. `written` is what the file says: levels between the two
// were removed by the clamp to the size. False after a report; `empty` when nothing of the span is there.
bool closeSpan(const SlotContext& context, const RefDesc& ref, const Entity& entity, const char* word,
               std::int64_t count, std::int64_t written, const Selection::Span& span, std::int64_t& first,
               std::int64_t& size, bool& empty) {
  first = span.openFirst ? 0 : span.first;
  std::int64_t last = span.openLast ? count - 1 : span.last;
  const bool clamped = first >= 0 && first < written && last >= first && last < written;
  if (clamped) last = std::min(last, count - 1);
  size = last - first + 1;
  const bool nothingLeft =
      clamped ? first >= count : span.openLast && first >= count && first <= std::max(count, written);
  if (nothingLeft || (!context.ranges && (first < 0 || last >= count || size < 1))) {
    empty = true;
    first = 0;
    size = 1;
    return true;
  }
  if (first >= 0 && last < count && size >= 1) return true;
  auto& d = report(
      context, Code::missingSubresource, span.place.line ? span.place : ref.place,
      fmt::format("{} uses {} {} of '{}', which is not there", context.user, word,
                  first == last ? fmt::format("{}", first) : fmt::format("{}..{}", first, last), entity.name),
      entity.name);
  d.expected =
      count == 1 ? fmt::format("{} 0, the only one", word) : fmt::format("{} 0 to {}", word, count - 1);
  d.found = ref.text;
  if (std::string_view(word) == "level")
    d.hint =
        fmt::format("\"mips\" says how many levels there are; bounds can be written with mips({})", ref.name);
  return false;
}

}  // namespace

bool collectLeaves(const SlotContext& context, Names& names, const RefDesc& ref, const Leaf& outer,
                   std::vector<Leaf>& leaves) {
  Model& model = context.model;
  Leaf leaf = outer;
  leaf.entity = findEntityOrReport(model, names.scope(), ref.name, ref.import, ref.place,
                                   {"{} uses the", context.user}, context.pass);
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
    if (!lookAt(model, costOf(alternative), alternative.place)) return false;
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

bool placeSelection(const SlotContext& context, const Leaf& leaf, const RefDesc& ref, SlotWork& work) {
  Model& model = context.model;
  work.entity = leaf.entity;
  if (!ensureShape(model, leaf.entity)) return false;
  const Entity& entity = model.entities[leaf.entity];
  const FlatResource& shape = entity.shape;
  const Selection& selection = leaf.selection;
  const bool texture = shape.kind == ResourceKind::texture || shape.kind == ResourceKind::imported_texture;
  const bool cube = isCube(shape);
  const auto misfit = [&](std::string message, std::string hint = {}) {
    return selectorMisfit(context, ref, entity, fmt::format("'{}' {}", entity.name, message),
                          std::move(hint));
  };
  if (!texture && (selection.mip || selection.layer || selection.face || selection.stencil))
    return misfit("is no texture, it has no levels, layers or planes");
  if (selection.element && entity.arrayCount == 0)
    return misfit("is no array", hintForElement(entity.name, *selection.element, texture && shape.mips > 1));
  if (selection.layer && shape.target == Target::texture_3d)
    return misfit("is a 3d texture, it has no layers");
  if (selection.face && !cube) return misfit("is no cube, it has no faces");
  if (selection.stencil && !hasStencil(shape.format))
    return misfit(
        fmt::format("({}) has no stencil", infoOf(shape.format).name),
        isDepth(shape.format) ? "formats with a stencil are depth24_stencil8 and depth32f_stencil8" : "");

  bool empty = false;
  std::int64_t mip = 0, mips = shape.mips, layer = 0, layers = cube ? shape.layers / 6 : shape.layers;
  if (selection.mip && !closeSpan(context, ref, entity, "level", shape.mips, entity.writtenMips,
                                  *selection.mip, mip, mips, empty))
    return false;
  if (selection.layer &&
      !closeSpan(context, ref, entity, "layer", layers, layers, *selection.layer, layer, layers, empty))
    return false;
  if (cube) {
    std::int64_t face = 0, faces = 6;
    if (selection.face && !closeSpan(context, ref, entity, "face", 6, 6, *selection.face, face, faces, empty))
      return false;
    if (faces < 6 && layers > 1)
      return misfit("has faces of several cubes, which are not next to each other");
    layer = layer * 6 + face;
    layers = faces < 6 ? faces : layers * 6;
  }
  work.array = entity.arrayCount > 0 && !selection.element;
  work.firstElement = 0;
  work.elementCount = std::max(1u, entity.arrayCount);
  if (selection.element) {
    Selection::Span span{*selection.element, *selection.element, false, false, selection.elementPlace};
    std::int64_t first = 0, size = 0;
    if (!closeSpan(context, ref, entity, "element", entity.arrayCount, entity.arrayCount, span, first, size,
                   empty))
      return false;
    work.firstElement = static_cast<std::uint32_t>(first);
    work.elementCount = 1;
  }
  work.whole = !selection.mip && !selection.layer && !selection.face && !selection.stencil;
  work.use.mip = static_cast<std::uint16_t>(mip);
  work.use.mips = static_cast<std::uint16_t>(mips);
  work.use.layer = static_cast<std::uint16_t>(layer);
  work.use.layers = static_cast<std::uint16_t>(layers);
  work.use.planes = selection.stencil ? 2 : planeMask(shape);
  work.sampler = leaf.sampler;
  work.border = leaf.border;
  work.state = empty ? SlotWork::State::empty : SlotWork::State::connected;
  return true;
}

namespace {

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
// The alternatives of a slot that is off, from `first` on.
void noteOthers(Model& model, const std::vector<Leaf>& leaves, Access access, std::size_t first) {
  for (std::size_t i = first; i < leaves.size(); ++i)
    wouldUse(model, leaves[i].entity, access, leaves[i].history);
}

}  // namespace

SlotWork resolveSlot(const SlotContext& context, const SlotDesc& slot, std::uint32_t pass) {
  using State = SlotWork::State;
  Model& model = context.model;
  const RefDesc& ref = slot.ref;
  SlotWork work;
  work.slot = &slot;
  work.use.access = slot.access;

  const std::uint32_t found =
      findEntityOrReport(model, context.names.scope(), ref.name, ref.import, ref.place,
                         {slot.access == Access::read    ? "{} reads the"
                          : slot.access == Access::write ? "{} writes the"
                                                         : "{} modifies the",
                          context.user},
                         context.pass, slot.name);
  if (found == kNone) return work;
  if (slot.access != Access::read && !isWritable(context, slot, found)) return work;

  const auto holds =
      evaluateCondition(context.names, ref.condition, true, {"the condition of slot '{}'", slot.name});
  if (!holds) return work;
  // A slot whose condition is false may select what is not there; the rest of it must make sense all the
  // same.
  SlotContext checked = context;
  if (!*holds) checked.ranges = false;

  std::vector<Leaf> own;
  std::vector<Leaf>& leaves = context.room ? *context.room : own;
  leaves.clear();
  if (!collectLeaves(checked, context.names, ref, Leaf{}, leaves)) return work;

  std::vector<MissingRead::Wanted> wanted;
  const auto addMissing = [&](MissingRead::Cause cause) {
    model.missing.push_back(
        {cause, pass, model.position, slot.name, &ref, false, slot.access, std::move(wanted)});
  };
  const bool looksForVersions = context.versions && *holds && slot.access != Access::write;
  bool onlyImports = !leaves.empty(), byCondition = false;
  const SlotWork blank = work;
  std::optional<SlotWork> zero;  // the first candidate that has no more than version zero
  for (const Leaf& leaf : leaves) {
    SlotWork candidate = blank;
    if (!placeSelection(checked, leaf, ref, candidate) ||
        !finishUse(checked, leaf, ref, slot.access, candidate))
      return work;
    const Entity& entity = model.entities[candidate.entity];
    const bool earlier = leaf.history > 0;
    if (earlier && !checkHistory(context, ref, leaf.history, entity)) return work;
    candidate.use.history = static_cast<std::uint8_t>(leaf.history);
    if (!*holds) {
      if (context.versions) {
        const bool placed = candidate.state == State::connected;
        if (placed) noteWould(model, candidate, WouldUse::Why::off);
        noteOthers(model, leaves, slot.access, placed ? 1 : 0);
      }
      candidate.state = slot.access == Access::read && !ref.optional ? State::missing : State::absent;
      work = std::move(candidate);
      if (work.state == State::missing && context.versions) addMissing(MissingRead::Cause::condition);
      return work;
    }
    if (candidate.state == State::empty) {
      if (ref.optional) candidate.state = State::absent;
      return candidate;
    }
    // Those behind one that is there by a condition, or from outside, are off as long as it is.
    byCondition = byCondition || leaf.conditional || entity.kind == ResourceDesc::Kind::import;
    const auto chosen = [&] {
      if (byCondition || !context.versions)
        noteOthers(model, leaves, slot.access, static_cast<std::size_t>(&leaf - leaves.data()) + 1);
      return candidate;
    };
    if (!looksForVersions || earlier) return chosen();
    bool complete = true, real = false;
    for (std::uint32_t e = candidate.firstElement; e < candidate.firstElement + candidate.elementCount; ++e) {
      const VersionCheck check = checkVersion(model, candidate.entity, e, candidate.use);
      real = real || check.real;
      if (complete && !check.complete) wanted.push_back({candidate.entity, e, check.missing, candidate.use});
      complete = complete && check.complete;
    }
    if (complete && real) return chosen();
    onlyImports = onlyImports && entity.kind == ResourceDesc::Kind::import;
    if (slot.access == Access::read)
      noteWould(model, candidate, complete && !ref.optional ? WouldUse::Why::zero : WouldUse::Why::empty);
    if (complete && !zero) zero = candidate;
    if (work.entity == kNone) work = std::move(candidate);
  }
  if (!context.versions) {
    work.state = State::absent;
    return work;
  }
  if (zero && !ref.optional) return *zero;
  if (ref.optional) {
    work.state = State::absent;
    return work;
  }
  work.state = State::missing;
  addMissing(leaves.empty() ? MissingRead::Cause::condition
             : onlyImports  ? MissingRead::Cause::import
                            : MissingRead::Cause::version);
  return work;
}

}  // namespace weft::graph::expansion
