// Whether uses fit what they use, and each other. Declared in passes.h.
#include <fmt/format.h>

#include <array>

#include "engine/graph/expand/passes.h"

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
  const auto refuse = [&](Code code, std::string_view why, std::string expected, const char* hint = "",
                          const RefDesc* at = nullptr) {
    const RefDesc& said = at ? *at : ref;
    return context.report(
        code, said.place,
        fmt::format("cannot {} '{}' as {}: {}", nameOf(access), entity.name, nameOf(kind), why),
        {.expected = std::move(expected),
         .found = known ? fmt::format("{}, of format {}", said.text, format.name) : said.text,
         .hint = hint,
         .resource = entity.name});
  };
  if (entity.import != kNone && context.model.graph.imports[entity.import].kind == ImportKind::event)
    return refuse(Code::badKind, "an event holds nothing", "a texture or a buffer; name events in \"reset\"");
  const KindRule& rule = kKindRules[static_cast<std::size_t>(kind)];
  const bool inPass = !type || (type->shader == ShaderShape::none ? kind == defaultKind(type, access, shape)
                                : type->shader == ShaderShape::compute ? rule.compute
                                                                       : rule.graphics);
  if (!inPass || !(buffer ? rule.buffer : rule.texture) ||
      !(access == Access::read ? rule.read : rule.write) ||
      (kind == Kind::indirect && (!type || !type->indirect)))
    return refuse(Code::badKind, fmt::format("it is a {}", buffer ? "buffer" : "texture"),
                  fmt::format("as {} is for {}", nameOf(kind), rule.takes));
  if (kind == Kind::indirect && (work.array || entity.import != kNone || ref.optional))
    return refuse(Code::badKind, "a command takes its arguments from one buffer of the graph",
                  "a buffer, without '?'");
  // A blit filters too, and says no more.
  const bool more = sampler.wrap != Wrap::clamp || sampler.compare;
  const bool filters = kind == Kind::sampled || (kind == Kind::copy && type && type->framebuffers &&
                                                 !buffer && access == Access::read && !more);
  if (type && (sampler.linear || more) && !filters)
    return refuse(Code::badKind, "it is not sampled, so it has no filter",
                  "linear, wrap, mirror, border and compare for sampled textures");
  if (sampler.linear && shape.samples > 1)
    return refuse(Code::badKind, "it has several samples, which are not filtered", "no linear",
                  "leave 'linear' out: the shader declares a sampler2DMS and reads one sample by texelFetch",
                  &words);
  const FixedSlot* const fixed = type ? findNamed(type->fixedSlots, work.slot->name) : nullptr;
  if (fixed && fixed->takes == (buffer ? FixedSlot::Takes::texture : FixedSlot::Takes::buffer))
    return refuse(Code::badSlots, buffer ? "it is a buffer" : "it is a texture",
                  buffer ? "a texture" : "a buffer");
  if (work.array && (kind == Kind::color || kind == Kind::depth || kind == Kind::copy))
    return refuse(Code::badKind, "it is an array, of which one element goes here", "one element, 'x[0]'");
  if (!known) return true;
  constexpr const char* kMisfit = "its format does not fit";
  if (kind == Kind::color && !format.colorRenderable)
    return refuse(Code::badFormat, kMisfit, "a format that can be rendered to");
  if (kind == Kind::image && !format.imageStorable)
    return refuse(Code::badFormat, kMisfit, "a format that images can have");
  if ((kind == Kind::depth || (kind == Kind::sampled && sampler.compare)) && !isDepth(shape.format))
    return refuse(Code::badFormat, kMisfit, "a depth format",
                  sampler.compare ? "name a depth texture, or leave 'compare' out" : "",
                  sampler.compare ? &words : nullptr);
  if (sampler.linear &&
      (isInteger(shape.format) || work.use.planes == 2 || (kind == Kind::copy && isDepth(shape.format))))
    return refuse(Code::badFormat, kMisfit, "a format that can be filtered",
                  "leave 'linear' out, or say 'as nearest' at the slot", &words);
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
  for (const SlotWork& work : slots) {
    if (!work.isConnected() && work.state != SlotWork::State::missing) continue;
    if (work.entity == kNone || (work.use.kind != Kind::color && work.use.kind != Kind::depth)) continue;
    const FlatResource& shape = context.model.entities[work.entity].shape;
    const SlotDesc& slot = *work.slot;
    if (work.use.kind == Kind::color) ++colors;
    const auto [width, height, depth] = sizeAt(shape, work.use.mip);
    const std::array<std::uint32_t, 5> here = {width, height,
                                               shape.target == Target::texture_3d ? depth : work.use.layers,
                                               shape.samples, work.use.mips};
    if (!first) all = here;
    if (!first) first = &work;
    if (work.use.mips > 1 || here != all)
      return context.report(
          Code::attachmentsDiffer, slot.ref.place,
          fmt::format("attaches '{}' ({}) beside '{}' ({})", slot.ref.text, textOf(here),
                      first->slot->ref.text, textOf(all)),
          {.expected = "one level of each, and one size, layer count and sample count",
           .hint =
               fmt::format("name a level, '{}.mip[0]', or repeat the pass over the levels", slot.ref.name)});
  }
  return colors <= 8 ||
         context.report(Code::attachmentsDiffer, slots[0].slot->place,
                        fmt::format("has {} color attachments", colors), {.expected = "at most 8"});
}

// `a` writes or modifies. False after a report.
bool checkTogether(const SlotContext& context, const SlotWork& a, const SlotWork& b, bool feedback) {
  const bool modifies = a.use.access == Access::modify, twice = b.use.access != Access::read;
  if (twice ? &b < &a : b.use.history > 0 || (modifies ? feedback : a.whole)) return true;
  return context.report(
      twice ? Code::writtenTwice : Code::readAndWritten, b.slot->ref.place,
      fmt::format("{} '{}' by slot '{}' and {} '{}' by slot '{}' at the same time",
                  twice ? "writes" : "reads", b.slot->ref.text, b.slot->name,
                  modifies ? "modifies" : "writes", a.slot->ref.text, a.slot->name),
      {.hint = twice ? "one pass writes a sub-resource once"
               : modifies
                   ? "say \"feedback\": true to read its own texel only, or \"write\" instead of \"modify\""
                   : "write another level or layer, or read and write the whole resource",
       .resource = context.model.entities[b.entity].name});
}

// The two slots of a pass type without a shader, as far as both are there: what GL would refuse, or would do in part.
bool checkCopy(const SlotContext& context, const std::vector<SlotWork>& slots) {
  const SlotWork *from = nullptr, *to = nullptr;
  for (const SlotWork& work : slots) {
    if (work.slot->ref.optional)
      return context.report(
          Code::badSlots, work.slot->ref.place, fmt::format("cannot do without its '{}'", work.slot->name),
          {.found = work.slot->ref.text,
           .hint = "leave '?' out; disable the pass where there is nothing to copy, or name a list of "
                   "alternatives"});
    if (work.isConnected()) (work.reads() ? from : to) = &work;
  }
  if (!from || !to) return true;
  const Entity &source = context.model.entities[from->entity], &target = context.model.entities[to->entity];
  const FlatResource &a = source.shape, &b = target.shape;
  const bool known = a.format != Format::none && b.format != Format::none;
  const auto refuse = [&](Code code, const SlotWork& side, std::string_view why, const char* expected) {
    const auto textOf = [](const SlotWork& work, const FlatResource& shape) {
      return isBuffer(shape) ? fmt::format("'{}' of {} bytes", work.slot->ref.text, shape.bytes)
                             : fmt::format("'{}' of {}x{}, {}", work.slot->ref.text, shape.width,
                                           shape.height, infoOf(shape.format).name);
    };
    return context.report(code, side.slot->ref.place,
                          fmt::format("cannot copy {} to {}: {}", textOf(*from, a), textOf(*to, b), why),
                          {.expected = expected, .resource = (&side == to ? target : source).name});
  };
  if (context.type->fromSource) {  // a mipmap reads one level and writes those that follow it
    if (from->entity != to->entity || from->firstElement != to->firstElement || from->use.mips != 1 ||
        to->use.mip != from->use.mip + 1 || from->use.layer != to->use.layer ||
        from->use.layers != to->use.layers)
      return refuse(Code::badSlots, *to, "its levels do not follow the one that is read",
                    "\"read\": { \"source\": \"x.mip[0]\" }, \"write\": { \"result\": \"x.mip[1..]\" }");
    return (!isInteger(b.format) && !hasStencil(b.format)) ||
           refuse(Code::badFormat, *to, "its format cannot be filtered",
                  "a format that can be filtered; a fullscreen pass for each level can choose among four "
                  "texels");
  }
  if (isBuffer(a) != isBuffer(b))
    return refuse(Code::badSlots, *to, "one side is a texture and one a buffer",
                  "two textures, or two buffers; a compute pass can move data from one to the other");
  if (isBuffer(a)) {
    if (a.kind == ResourceKind::imported_buffer)
      return refuse(Code::badSlots, *from, "it is a table of the world",
                    "a buffer of the graph, or a compute pass");
    return a.bytes == b.bytes ||
           refuse(Code::badSlots, *to, "the buffers differ in size", "as many bytes as the source");
  }
  for (const SlotWork* side : {from, to})
    if (side->use.mips != 1 || side->use.layers != 1 || (side == from ? a : b).target == Target::texture_3d)
      return refuse(Code::badSlots, *side, "it has several levels, layers or slices",
                    "one level and layer, such as 'x.mip[0]'; a pass may repeat over them");
  const bool oneSize = sizeAt(a, from->use.mip) == sizeAt(b, to->use.mip);
  const bool several = a.samples > 1 || b.samples > 1, depth = isDepth(a.format) || isDepth(b.format);
  if (several && (!oneSize || (a.samples > 1 && b.samples > 1 && a.samples != b.samples)))
    return refuse(Code::badSlots, *to, "the sides differ in size or samples",
                  "one size where a texture has several samples, and as many samples, or one");
  const bool integers = isInteger(a.format) || isInteger(b.format);
  if (known && (depth ? a.format != b.format : integers && infoOf(a.format).kind != infoOf(b.format).kind))
    return refuse(Code::badFormat, *to, "the formats do not fit",
                  "equal depth formats, or both integer of one sign, or both neither");
  if (known && from->use.planes != to->use.planes)
    return refuse(Code::badSlots, *to, "one side is a stencil", "both the whole, or both '.stencil'");
  // Texels of one format are moved as they are; all else renders.
  if (known && !depth && (!oneSize || a.format != b.format || several))
    for (const SlotWork* each : {from, to})
      if (!infoOf((each == from ? a : b).format).colorRenderable)
        return refuse(Code::badFormat, *each, "its format cannot be rendered to",
                      "equal formats and sizes, or formats that can be rendered to");
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
      Code::noHistory, ref.place,
      fmt::format("reads '{}', further back than '{}' remembers", ref.text, entity.name),
      {.expected = entity.depth > 0 ? fmt::format("@-1 to @-{}", entity.depth) : "what has a \"history\"",
       .hint = import ? "let a pass write it into a texture or buffer with \"history\", and read that"
                      : fmt::format("declare \"history\": {} on '{}'{}", history, entity.name,
                                    input ? ", or on this file's input" : ""),
       .resource = entity.name});
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
  context.report(Code::addsUp, work.slot->ref.place,
                 fmt::format("runs in every frame and modifies '{}', which '{}' makes only {}",
                             work.slot->ref.text, graph.passNames[slower],
                             graph.passes[slower].cadence == Cadence::once    ? "once"
                             : graph.passes[slower].cadence == Cadence::every ? "every few frames"
                                                                              : "on change"),
                 {.hint = "read it and write another resource, or give both passes one \"update\"",
                  .resource = context.model.entities[work.entity].name});
}

}  // namespace weft::graph::expansion
