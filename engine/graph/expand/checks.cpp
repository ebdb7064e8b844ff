// Whether uses fit what they use, and each other. Declared in passes.h.
#include <fmt/format.h>

#include <array>

#include "engine/graph/expand/passes.h"
#include "graph_sentences.h"

namespace weft::graph::expansion {

bool coversAll(const PassType* type, const PassDesc& desc, const SlotWork& work) {
  const bool attached = work.use.kind == Kind::color || work.use.kind == Kind::depth;
  return !attached || !type || (type->shader != ShaderShape::draw && !findNamed(desc.state, "viewport"));
}

bool isInteger(Format format) {
  const TexelKind kind = infoOf(format).kind;
  return kind == TexelKind::unsigned_integer || kind == TexelKind::signed_integer;
}

Kind defaultKind(const PassType* type, Access access, const FlatResource& shape) {
  if (!type) return Kind::copy;
  if (isBuffer(shape)) return type->shader == ShaderShape::none ? Kind::copy : Kind::storage;
  if (access == Access::read) return type->defaultReadTexture;
  return type->defaultWriteTexture == Kind::color && isDepth(shape.format) ? Kind::depth
                                                                           : type->defaultWriteTexture;
}

namespace {

// What a kind of use is for, in the order of Kind.
struct KindRule {
  bool texture, buffer, read, write;  // of which resources, by which accesses
  bool graphics, compute;             // in fullscreen and draw passes; in compute passes
  const char* takes;
};
constexpr KindRule kKindRules[] = {
    {true, false, true, false, true, true, "a texture that a shader reads"},      // sampled
    {true, false, true, true, true, true, "a texture, in a pass with a shader"},  // image
    {false, true, true, false, true, true, "a buffer that a shader reads"},       // uniform
    {false, true, true, true, true, true, "a buffer, in a pass with a shader"},   // storage
    {false, true, true, false, true, true,
     "a buffer that a draw or compute pass takes its arguments from"},  // indirect
    {true, false, false, true, true, false,
     "a texture that a draw writes or modifies; image in a compute pass"},          // color
    {true, false, true, true, true, false, "a depth texture of a draw"},            // depth
    {true, true, true, true, false, false, "what a pass without a shader copies"},  // copy
};

}  // namespace

bool checkUse(const SlotContext& context, const RefDesc& ref, Access access, const SlotWork& work) {
  const Entity& entity = context.model.entities[work.entity];
  const FlatResource& shape = entity.shape;
  const Kind kind = work.use.kind;
  const PassType* const type = context.type;
  const Sampler& sampler = work.sampler;
  const FormatInfo& format = infoOf(shape.format);
  const bool known = shape.format != Format::none, buffer = isBuffer(shape);
  const RefDesc& words = work.sampling ? *work.sampling : ref;
  const KindRule& rule = kKindRules[static_cast<std::size_t>(kind)];
  using Misfit =
      text::SentenceFor<const char*, std::string, const char*, const char*, const char*, std::string>;
  const auto refuseAt = [&](const RefDesc& at, Misfit why) {
    const std::string found = known ? fmt::format("{}, of format {}", at.text, format.name) : at.text;
    return context.reportChecked(why, at.place, nameOf(access), entity.name, nameOf(kind),
                                 buffer ? "buffer" : "texture", rule.takes, found);
  };
  const auto refuse = [&](Misfit why) { return refuseAt(ref, why); };
  if (entity.import != kNone && context.model.graph.imports[entity.import].kind == ImportKind::event)
    return refuse(say::eventHoldsNothing);
  const bool inPass = !type || (type->shader == ShaderShape::none ? kind == defaultKind(type, access, shape)
                                : type->shader == ShaderShape::compute ? rule.compute
                                                                       : rule.graphics);
  if (!inPass || !(buffer ? rule.buffer : rule.texture) ||
      !(access == Access::read ? rule.read : rule.write) ||
      (kind == Kind::indirect && (!type || !type->indirect)))
    return refuse(say::kindDoesNotFit);
  if (kind == Kind::indirect && (work.array || entity.import != kNone || ref.optional))
    return refuse(say::argumentsOfOneBuffer);
  // A blit filters too, and says no more.
  const bool more = sampler.wrap != Wrap::clamp || sampler.compare;
  const bool filters = kind == Kind::sampled || (kind == Kind::copy && type && type->framebuffers &&
                                                 !buffer && access == Access::read && !more);
  if (type && (sampler.linear || more) && !filters) return refuse(say::isNotSampled);
  if (sampler.linear && shape.samples > 1) return refuseAt(words, say::samplesNotFiltered);
  const FixedSlot* const fixed = type ? findNamed(type->fixedSlots, work.slot->name) : nullptr;
  if (fixed && fixed->takes == (buffer ? FixedSlot::Takes::texture : FixedSlot::Takes::buffer))
    return buffer ? refuse(say::slotTakesTexture) : refuse(say::slotTakesBuffer);
  if (work.array && (kind == Kind::color || kind == Kind::depth || kind == Kind::copy))
    return refuse(say::arrayForElement);
  if (!known) return true;
  if (kind == Kind::color && !format.colorRenderable) return refuse(say::notRenderable);
  if (kind == Kind::image && !format.imageStorable) return refuse(say::notForImages);
  if ((kind == Kind::depth || (kind == Kind::sampled && sampler.compare)) && !isDepth(shape.format))
    return sampler.compare ? refuseAt(words, say::notDepthToCompare) : refuse(say::notDepth);
  if (sampler.linear &&
      (isInteger(shape.format) || work.use.planes == 2 || (kind == Kind::copy && isDepth(shape.format))))
    return refuseAt(words, say::notFiltered);
  return true;
}

namespace {

bool checkAttachments(const SlotContext& context, const std::vector<SlotWork>& slots) {
  const SlotWork* first = nullptr;
  std::array<std::uint32_t, 5> all{};  // what the first one is
  const auto textOf = [](const std::array<std::uint32_t, 5>& size) {
    return fmt::format("{}x{}, {} layers, {} samples, {} levels", size[0], size[1], size[2], size[3],
                       size[4]);
  };
  int colors = 0;
  bool deep = false;
  for (const SlotWork& work : slots) {
    if (!work.isConnected() && work.state != SlotWork::State::missing) continue;
    if (work.entity == kNone || (work.use.kind != Kind::color && work.use.kind != Kind::depth)) continue;
    const FlatResource& shape = context.model.entities[work.entity].shape;
    const SlotDesc& slot = *work.slot;
    if (work.use.kind == Kind::color)
      ++colors;
    else if (std::exchange(deep, true))
      return context.report(say::secondDepth, slot.ref.place, slot.ref.text);
    const auto [width, height, depth] = sizeAt(shape, work.use.mip);
    const std::array<std::uint32_t, 5> here = {width, height,
                                               shape.target == Target::texture_3d ? depth : work.use.layers,
                                               shape.samples, work.use.mips};
    if (!first) all = here;
    if (!first) first = &work;
    if (work.use.mips > 1 || here != all)
      return context.report(say::attachmentsDiffer, slot.ref.place, slot.ref.text, textOf(here),
                            first->slot->ref.text, textOf(all), slot.ref.name);
  }
  return colors <= 8 || context.report(say::tooManyColors, slots[0].slot->place, colors);
}

// `a` writes or modifies. False after a report.
bool checkTogether(const SlotContext& context, const SlotWork& a, const SlotWork& b, bool feedback) {
  const bool modifies = a.use.access == Access::modify, twice = b.use.access != Access::read;
  if (twice ? &b < &a : b.use.history > 0 || (modifies ? feedback : a.whole)) return true;
  using Clash =
      text::SentenceFor<std::string, std::string, const char*, std::string, std::string, std::string>;
  const auto refuse = [&](Clash why) {
    return context.reportChecked(why, b.slot->ref.place, b.slot->ref.text, b.slot->name, verbOf(a.use.access),
                                 a.slot->ref.text, a.slot->name, context.model.entities[b.entity].name);
  };
  return twice      ? refuse(say::writtenTwice)
         : modifies ? refuse(say::readAndModified)
                    : refuse(say::readAndWritten);
}

// The two slots of a pass type without a shader, as far as both are there: what GL would refuse, or would do in part.
bool checkCopy(const SlotContext& context, const std::vector<SlotWork>& slots) {
  const SlotWork *from = nullptr, *to = nullptr;
  for (const SlotWork& work : slots) {
    if (work.slot->ref.optional)
      return context.report(say::optionalInCopy, work.slot->ref.place, work.slot->name, work.slot->ref.text);
    if (work.isConnected()) (work.reads() ? from : to) = &work;
  }
  if (!from || !to) return true;
  const Entity &source = context.model.entities[from->entity], &target = context.model.entities[to->entity];
  const FlatResource &a = source.shape, &b = target.shape;
  const bool known = a.format != Format::none && b.format != Format::none;
  const auto refuse = [&](const SlotWork& side,
                          text::SentenceFor<std::string, std::string, std::string> why) {
    const auto textOf = [](const SlotWork& work, const FlatResource& shape) {
      return isBuffer(shape) ? fmt::format("'{}' of {} bytes", work.slot->ref.text, shape.bytes)
                             : fmt::format("'{}' of {}x{}, {}", work.slot->ref.text, shape.width,
                                           shape.height, infoOf(shape.format).name);
    };
    return context.reportChecked(why, side.slot->ref.place, textOf(*from, a), textOf(*to, b),
                                 (&side == to ? target : source).name);
  };
  if (context.type->fromSource) {  // a mipmap reads one level and writes those that follow it
    if (from->entity != to->entity || from->firstElement != to->firstElement || from->use.mips != 1 ||
        to->use.mip != from->use.mip + 1 || from->use.layer != to->use.layer ||
        from->use.layers != to->use.layers)
      return refuse(*to, say::levelsDoNotFollow);
    return (!isInteger(b.format) && !hasStencil(b.format)) || refuse(*to, say::mipsNotFiltered);
  }
  if (isBuffer(a) != isBuffer(b)) return refuse(*to, say::textureAndBuffer);
  if (isBuffer(a)) {
    if (a.kind == ResourceKind::imported_buffer) return refuse(*from, say::tableOfWorld);
    return a.bytes == b.bytes || refuse(*to, say::buffersDifferInSize);
  }
  for (const SlotWork* side : {from, to})
    if (side->use.mips != 1 || side->use.layers != 1 || (side == from ? a : b).target == Target::texture_3d)
      return refuse(*side, say::severalParts);
  const bool oneSize = sizeAt(a, from->use.mip) == sizeAt(b, to->use.mip);
  const bool several = a.samples > 1 || b.samples > 1, depth = isDepth(a.format) || isDepth(b.format);
  if (several && (!oneSize || (a.samples > 1 && b.samples > 1 && a.samples != b.samples)))
    return refuse(*to, say::samplesDiffer);
  const bool integers = isInteger(a.format) || isInteger(b.format);
  if (known && (depth ? a.format != b.format : integers && infoOf(a.format).kind != infoOf(b.format).kind))
    return refuse(*to, say::formatsDiffer);
  if (known && from->use.planes != to->use.planes) return refuse(*to, say::oneSideStencil);
  if (known && !depth)  // it renders
    for (const SlotWork* each : {from, to})
      if (!infoOf((each == from ? a : b).format).colorRenderable)
        return refuse(*each, say::copyNotRenderable);
  return true;
}

}  // namespace

bool checkPassUses(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots) {
  bool good = checkAttachments(context, slots);
  if (context.type && context.type->shader == ShaderShape::none) good = checkCopy(context, slots) && good;
  for (const SlotWork& a : slots) {
    if (!a.isConnected() || a.use.access == Access::read) continue;
    for (const SlotWork& b : slots)
      if (&a != &b && b.isConnected() && a.overlaps(b))
        if (!good || !checkTogether(context, a, b, desc.feedback)) return false;
  }
  return good;
}

bool checkHistory(const SlotContext& context, const RefDesc& ref, int history, const Entity& entity) {
  const bool import = entity.kind == ResourceDesc::Kind::import;
  if (!import && history <= static_cast<int>(entity.depth)) return true;
  const bool input = entity.scope != &context.names.scope() && ref.name.find('.') == std::string::npos;
  return context.report(
      say::furtherBackThanKept, ref.place, ref.text, entity.name,
      entity.depth > 0 ? fmt::format("@-1 to @-{}", entity.depth) : "what has a \"history\"",
      import ? "let a pass write it into a texture or buffer with \"history\", and read that"
             : fmt::format("declare \"history\": {} on '{}'{}", history, entity.name,
                           input ? ", or on this file's input" : ""));
}

void checkAccumulation(const SlotContext& context, const SlotWork& work, std::uint32_t firstUse) {
  const FlatGraph& graph = context.model.graph;
  std::uint32_t slower = kNone;  // the first of those it adds to
  for (std::uint32_t i = 0; i < work.elementCount; ++i)
    graph.links.forEachWriter(graph.links.seen[firstUse + i], [&](std::uint32_t use) {
      const std::uint32_t writer = graph.links.passOf[use];
      if (slower == kNone && graph.passes[writer].cadence != Cadence::always) slower = writer;
    });
  if (slower == kNone) return;
  context.report(say::addsUp, work.slot->ref.place, work.slot->ref.text, graph.passNames[slower],
                 graph.passes[slower].cadence == Cadence::once    ? "once"
                 : graph.passes[slower].cadence == Cadence::every ? "every few frames"
                                                                  : "on change",
                 context.model.entities[work.entity].name);
}

}  // namespace weft::graph::expansion
