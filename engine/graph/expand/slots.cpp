// Declared in passes.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/graph/expand/passes.h"
#include "engine/graph/subresource.h"
#include "graph_sentences.h"

namespace weft::graph::expansion {

namespace {

using State = SlotWork::State;

// Further out than any limit; ranges are checked against shapes later.
constexpr std::int64_t kFar = 1'000'000;
constexpr const char* kPartWords[] = {"level", "layer", "face", "element"};  // by Selection::Part

// Adds the selectors of `ref` to what is selected already (from outside: a slot that selects in an alternative).
bool addSelection(const SlotContext& context, Names& names, const RefDesc& ref, Selection& into) {
  into.stencil = into.stencil || ref.stencil;
  const std::optional<SpanDesc>* const parts[] = {&ref.mip, &ref.layer, &ref.face, &ref.element};
  for (std::size_t i = 0; i < std::size(parts); ++i) {
    if (!*parts[i]) continue;
    const SpanDesc& said = **parts[i];
    const auto first = evaluateWhole(names, said.first, 0, -kFar, kFar, kPartWords[i]);
    const auto last = evaluateWhole(names, said.last, 0, -kFar, kFar, kPartWords[i]);
    if (!first || !last) return false;
    if (into.parts[i]) return context.report(say::selectsTwice, ref.place, ref.text, ref.name);
    into.parts[i] = {*first, said.range ? *last : *first, said.range && !said.last.present(),
                     said.first.present() ? said.first.place() : said.last.place()};
  }
  return true;
}

struct Range {
  std::int64_t first = 0, size = 1;
  bool empty = false;  // nothing of the span is there at this size
};

// Fills open ends and holds a span against how many parts there are; `written`: as the file says, levels between the two were
// removed by the clamp to the size. nullopt: it is not there.
std::optional<Range> closeSpan(const Selection::Span& said, std::int64_t count, std::int64_t written,
                               bool ranges) {
  const std::int64_t first = said.first;
  std::int64_t last = said.openLast ? count - 1 : said.last;
  const bool clamped = first >= 0 && first < written && last >= first && last < written;
  if (clamped) last = std::min(last, count - 1);
  const bool nothingLeft =
      clamped ? first >= count : said.openLast && first >= count && first <= std::max(count, written);
  const bool there = first >= 0 && last < count && last >= first;
  if (nothingLeft || (!ranges && !there)) return Range{.empty = true};
  return there ? std::optional(Range{first, last - first + 1}) : std::nullopt;
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
  const bool texture = !isBuffer(shape), cube = isCube(shape), deep = shape.target == Target::texture_3d;
  const auto misfit = [&](std::string_view what, std::string hint = {}) {
    if (hint.empty()) hint = "leave the selector out, or name a resource that has such parts";
    return context.report(say::selectorMisfits, ref.place, entity.name, what, ref.text, hint);
  };
  const std::int64_t counts[] = {texture ? shape.mips : 0,
                                 !texture || deep ? 0
                                 : cube           ? shape.layers / 6
                                                  : shape.layers,
                                 cube ? 6 : 0, entity.arrayCount};
  Range ranges[4];
  bool empty = false;
  for (std::size_t i = 0; i < std::size(counts); ++i) {
    const auto& said = selection.parts[i];
    ranges[i].size = std::max<std::int64_t>(1, counts[i]);
    if (!said) continue;
    if (i == Selection::element && counts[i] == 0)
      return misfit("is no array", said->first < 0 ? fmt::format("write '{}@{}' for an earlier frame",
                                                                 entity.name, said->first)
                                                   : fmt::format("a level is '{}.mip[…]'", entity.name));
    if (counts[i] == 0) return misfit(fmt::format("has no {}s", kPartWords[i]));
    const auto range =
        closeSpan(*said, counts[i], i == Selection::level ? entity.writtenMips : counts[i], context.ranges);
    if (!range)
      return context.report(say::partNotThere, said->place.line ? said->place : ref.place, kPartWords[i],
                            entity.name, counts[i] - 1,
                            said->first == said->last ? fmt::format("{}", said->first)
                                                      : fmt::format("{}..{}", said->first, said->last));
    ranges[i] = *range;
    empty = empty || range->empty;
  }
  auto& [levels, layers, faces, elements] = ranges;
  if (selection.stencil && !hasStencil(shape.format))
    return misfit("has no stencil", "formats with a stencil are depth24_stencil8 and depth32f_stencil8");
  if (cube && faces.size < 6 && layers.size > 1)
    return misfit("has faces of several cubes, which are not next to each other");
  if (cube) layers = {layers.first * 6 + faces.first, faces.size < 6 ? faces.size : layers.size * 6};
  const auto selects = [](const auto& said) { return said.has_value(); };
  work.array = entity.arrayCount > 0 && !selection.parts[Selection::element];
  work.firstElement = static_cast<std::uint32_t>(elements.first);
  work.elementCount = static_cast<std::uint32_t>(elements.size);
  work.whole = !selection.stencil && std::none_of(&selection.parts[Selection::level],
                                                  &selection.parts[Selection::element], selects);
  work.use.mip = static_cast<std::uint16_t>(levels.first);
  work.use.mips = static_cast<std::uint16_t>(levels.size);
  work.use.layer = static_cast<std::uint16_t>(layers.first);
  work.use.layers = static_cast<std::uint16_t>(layers.size);
  work.use.planes = selection.stencil ? 2 : planeMask(shape);
  work.state = empty ? State::empty : State::connected;
  return true;
}

// Notes what a slot would read if the conditions on the way to `leaf` held, or nothing in front of it were there. What it selects need
// not be there: nobody reads it.
void noteOff(const SlotContext& context, const Leaf& leaf, const RefDesc& ref) {
  const Entity& entity = context.model.entities[leaf.entity];
  if (!entity.isOwn() || entity.state != Progress::done) return;
  SlotContext off = context;
  off.ranges = false;
  off.quiet = true;
  SlotWork work;
  if (!placeSelection(off, leaf, ref, work) || !work.isConnected()) return;
  work.use.kind = Kind::copy;
  work.use.history = static_cast<std::uint8_t>(leaf.history);
  wouldUse(context.model, {work});
}

// All concrete candidates of a reference whose conditions hold, in order; the others are noted. `leaf` says what `ref` means, and what
// is said of it from outside; `sample` how that is sampled by itself; `unbound` becomes an input to which nothing is bound. False after a report.
bool collectLeaves(const SlotContext& context, Names& names, const RefDesc& ref, const RefDesc* sample,
                   Leaf leaf, std::vector<Leaf>& leaves, std::string& unbound) {
  Model& model = context.model;
  if (!addSelection(context, names, ref, leaf.selection)) return false;
  if (!leaf.kind) leaf.kind = ref.kind;
  if (!leaf.sampling) leaf.sampling = ref.samples ? &ref : sample;
  leaf.history += ref.history;
  Entity& entity = model.entities[leaf.entity];
  if (!leaf.off) entity.firstRead = std::min(entity.firstRead, model.position);
  if (entity.kind != ResourceDesc::Kind::alternatives) {
    if (leaf.off)
      noteOff(context, leaf, ref);
    else
      leaves.push_back(std::move(leaf));
    return true;
  }
  if (entity.state == Progress::failed) return false;  // reported
  if (entity.desc->kind == ResourceDesc::Kind::input && !leaf.off) unbound = entity.desc->name;
  Names listNames(model, *entity.scope);
  bool good = true;
  for (std::size_t i = 0; i < entity.candidates.size(); ++i) {
    if (entity.candidates[i] == kNone) continue;
    const RefDesc& alternative = entity.desc->alternatives[i];
    const auto holds =
        evaluateCondition(listNames, alternative.condition, true, "the condition of an alternative");
    good = good && holds;
    if (!holds) continue;
    Leaf within = leaf;
    within.entity = entity.candidates[i];
    within.conditional = leaf.conditional || alternative.condition.present();
    within.off = leaf.off || !*holds;
    good = collectLeaves(context, listNames, alternative, entity.samples[i], std::move(within), leaves,
                         unbound) &&
           good;
  }
  return good;
}

bool isWritable(const SlotContext& context, const SlotDesc& slot, std::uint32_t found) {
  const Entity& entity = context.model.entities[found];
  const bool unbound = entity.desc && entity.desc->kind == ResourceDesc::Kind::input;
  return ((unbound || entity.isOwn()) && slot.ref.history == 0) ||
         context.report(say::notWritable, slot.ref.place, verbOf(slot.access), slot.ref.text, entity.name);
}

SlotWork noneOf(const SlotDesc& slot) {
  SlotWork work;
  work.slot = &slot;
  work.use.access = slot.access;
  return work;
}

// A slot, which its alternatives may leave without a resource.
struct SlotChoice {
  const SlotContext& context;
  const SlotDesc& slot;
  std::uint32_t pass;  // whose the slot is, for what is missing
  const std::vector<Leaf>& leaves;
  const std::string& unbound;  // an input
  std::vector<MissingRead::Wanted> wanted{};

  // The first alternative that has a version, or the first with no more than version zero, or nothing.
  SlotWork choose() {
    bool onlyImports = !leaves.empty(), byCondition = false;
    std::optional<SlotWork> zero, first;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      SlotWork work = noneOf(slot);
      if (!place(leaves[i], work)) return noneOf(slot);
      if (work.state == State::empty) {
        if (slot.ref.optional) work.state = State::absent;
        return work;
      }
      const bool import = context.model.entities[work.entity].kind == ResourceDesc::Kind::import;
      const bool asks = context.versions && slot.access != Access::write && work.use.history == 0;
      const VersionCheck found = asks ? versionsOf(work) : VersionCheck{.real = true};
      // Those behind one that is there by a condition, or from outside, are off as long as it is.
      byCondition = byCondition || leaves[i].conditional || import;
      if (found.complete && found.real) {
        if (byCondition || !context.versions)
          for (std::size_t other = i + 1; other < leaves.size(); ++other)
            noteOff(context, leaves[other], slot.ref);
        return work;
      }
      onlyImports = onlyImports && import;
      if (slot.access == Access::read && context.versions)
        wouldUse(context.model,
                 {work, found.complete && !slot.ref.optional ? WouldUse::Why::zero : WouldUse::Why::empty});
      if (found.complete && !zero) zero = work;
      if (!first) first = std::move(work);
    }
    if (zero && !slot.ref.optional) return *zero;
    SlotWork work = first.value_or(noneOf(slot));
    // A mistake, unless the slot says that it can do without.
    const bool missing = context.versions && !slot.ref.optional;
    work.state = missing ? State::missing : State::absent;
    using Why = MissingRead::Cause;
    if (missing)
      context.model.missing.push_back({leaves.empty() ? Why::condition
                                       : onlyImports  ? Why::import
                                                      : Why::version,
                                       pass, context.model.position, slot.name, slot.ref, false, slot.access,
                                       std::move(wanted), leaves.empty() ? unbound : ""});
    return work;
  }

  bool place(const Leaf& leaf, SlotWork& work) const {
    if (!placeSelection(context, leaf, slot.ref, work)) return false;
    const Entity& entity = context.model.entities[work.entity];
    work.use.access = slot.access;
    work.use.kind = leaf.kind.value_or(defaultKind(context.type, slot.access, entity.shape));
    // What is said elsewhere is for those that sample.
    if (leaf.sampling && (work.use.kind == Kind::sampled || leaf.sampling == &slot.ref)) {
      work.sampling = leaf.sampling;
      work.sampler = leaf.sampling->sampler;
      work.border = leaf.sampling->border;
      if (work.sampler.compare) work.sampler.linear = true;
    }
    const bool shaderRead = work.use.kind == Kind::sampled || work.use.kind == Kind::image;
    if (shaderRead && work.use.planes == 3)
      work.use.planes = 1;  // a shader sees depth unless .stencil is said
    work.use.history = static_cast<std::uint8_t>(leaf.history);
    return checkUse(context, slot.ref, slot.access, work) &&
           (leaf.history == 0 || checkHistory(context, slot.ref, leaf.history, entity));
  }

  // Of all elements together. Notes what is not there.
  VersionCheck versionsOf(const SlotWork& work) {
    VersionCheck all;
    for (std::uint32_t e = work.firstElement; e < work.firstElement + work.elementCount; ++e) {
      const VersionCheck check = checkVersion(context.model, work.entity, e, work.use);
      all.real = all.real || check.real;
      if (all.complete && !check.complete) wanted.push_back({work.entity, e, check.missing, work.use});
      all.complete = all.complete && check.complete;
    }
    return all;
  }
};

}  // namespace

bool SlotContext::report(text::Diagnostic said, const Place& place) const {
  said.message = fmt::format("{} {}", whoIs(user, pass), said.message);
  said.pass = pass;
  if (!quiet) model.diagnostics.add(text::Severity::error, std::move(said), place);
  return false;
}

SlotWork resolveSlot(const SlotContext& context, const SlotDesc& slot, std::uint32_t pass) {
  const RefDesc& ref = slot.ref;
  const RefDesc* sample = nullptr;
  const std::uint32_t found = findEntityOrReport(context.model, context.names.scope(), ref, context.user,
                                                 verbOf(slot.access), context.pass, &sample);
  if (found == kNone || (slot.access != Access::read && !isWritable(context, slot, found)))
    return noneOf(slot);
  std::vector<Leaf> leaves;
  std::string unbound;
  if (!collectLeaves(context, context.names, ref, sample, {.entity = found}, leaves, unbound))
    return noneOf(slot);
  return SlotChoice{context, slot, pass, leaves, unbound}.choose();
}

// ---- what is read in the place of a publication that is not there yet ----

namespace {

// "a texture of 8x8, 6 layers, rgba16f"
std::string shapeText(const FlatResource& shape, std::uint32_t mip, std::uint32_t layers) {
  if (isBuffer(shape)) return fmt::format("a buffer of {} bytes", shape.bytes);
  return fmt::format("a {} of {}, {} layers, {} samples, {}", isCube(shape) ? "cube" : "texture",
                     fmt::join(sizeAt(shape, mip), "x"), layers, shape.samples, infoOf(shape.format).name);
}

// Whether `first`, the whole of `theirs`, can be read where `work` reads the history of `mine`.
bool canReplace(const FlatResource& mine, const SlotWork& work, const FlatResource& theirs,
                const SlotWork& first) {
  if (first.array || first.use.history > 0 || isBuffer(mine) != isBuffer(theirs)) return false;
  if (isBuffer(mine)) return theirs.kind == ResourceKind::buffer && theirs.bytes >= mine.bytes;
  // A pass that tests depth against the history attaches it.
  if (work.use.kind == Kind::depth || work.use.mip >= first.use.mips) return false;
  const bool sampled = work.use.kind == Kind::sampled && work.use.planes == 1;
  FlatResource same = theirs;  // what a sampler makes a float of may have another format
  if (sampled && isInteger(mine.format) == isInteger(theirs.format) &&
      (!isInteger(mine.format) || infoOf(mine.format).kind == infoOf(theirs.format).kind) &&
      (!work.sampler.compare || isDepth(theirs.format)))
    same.format = mine.format;
  return isCube(mine) == (isCube(theirs) && first.use.layers % 6 == 0) &&
         shapeText(mine, 0, mine.layers) == shapeText(same, first.use.mip, first.use.layers);
}

}  // namespace

SlotWork resolveFirst(const SlotContext& context, const SlotWork& work, std::uint32_t pass, SlotDesc& slot) {
  Model& model = context.model;
  Entity& entity = model.entities[work.entity];
  if (!entity.firstRef) return {};
  const RefDesc& ref = *entity.firstRef;
  slot = {SlotHead{work.slot->name, ref.place, Access::read}, ref};
  slot.ref.kind = work.use.kind;
  Names names(model, *entity.firstScope);
  const SlotContext inside{model,         names, context.type, context.user, context.pass, context.versions,
                           context.ranges};
  const std::size_t missed = model.missing.size();
  SlotWork first = resolveSlot(inside, slot, pass);
  if (model.missing.size() > missed) model.missing.back().first = true;
  if (!first.isConnected()) return {};

  const FlatResource& source = model.entities[first.entity].shape;
  if (!canReplace(entity.shape, work, source, first)) {
    context.report(say::firstMisfits, ref.place, ref.text, entity.name,
                   shapeText(entity.shape, 0, entity.shape.layers),
                   shapeText(source, first.use.mip, first.use.layers));
    return {};
  }
  entity.firstUse = first.use;
  entity.firstUse.resource = currentResource(model, first.entity, first.firstElement);
  if (!isBuffer(source)) {
    const std::uint32_t levels = first.use.mips - work.use.mip;
    first.use.mip = static_cast<std::uint16_t>(first.use.mip + work.use.mip);
    first.use.mips = static_cast<std::uint16_t>(std::min<std::uint32_t>(work.use.mips, levels));
    first.use.layer = static_cast<std::uint16_t>(first.use.layer + work.use.layer);
    first.use.layers = work.use.layers;
    first.use.planes = work.use.planes;
  }
  first.elementCount = 1;
  return first;
}

}  // namespace weft::graph::expansion
