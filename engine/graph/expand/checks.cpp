#include "engine/graph/expand/checks.h"

#include <fmt/format.h>

#include <algorithm>

namespace weft::graph::expansion {

bool coversAll(const PassType* type, const SlotWork& work) {
  return !type || type->shader != ShaderShape::draw ||
         (work.use.kind != Kind::color && work.use.kind != Kind::depth);
}

bool isInteger(Format format) {
  const TexelKind kind = infoOf(format).kind;
  return kind == TexelKind::unsigned_integer || kind == TexelKind::signed_integer;
}

const PassType* findPassType(const Registry& registry, std::string_view name) {
  const auto found = std::ranges::find(registry.passTypes, name, &PassType::name);
  return found == registry.passTypes.end() ? nullptr : &*found;
}

Sampler layOver(const Sampler& outer, const Sampler& inner) {
  Sampler both = outer.wrap == Wrap::clamp ? inner : outer;
  both.linear = outer.linear || inner.linear;
  both.compare = outer.compare || inner.compare;
  both.function = outer.function ? outer.function : inner.function;
  return both;
}

Kind defaultKind(const PassType* type, Access access, const FlatResource& shape) {
  if (!type) return Kind::copy;
  if (isBuffer(shape)) return type->shader == ShaderShape::none ? Kind::copy : Kind::storage;
  if (access == Access::read) return type->defaultReadTexture;
  return type->defaultWriteTexture == Kind::color && isDepth(shape.format) ? Kind::depth
                                                                           : type->defaultWriteTexture;
}

namespace {

struct Use {
  const FlatResource& shape;
  Kind kind;
  Access access;
  const PassType* type;  // null: present, outputs, resets
  const SlotWork& work;
  bool event;  // of an import that holds nothing

  ShaderShape shader() const { return type ? type->shader : ShaderShape::none; }
  bool hasShader() const { return type && type->shader != ShaderShape::none; }
  bool attaches() const { return kind == Kind::color || kind == Kind::depth; }
  bool ofBuffers() const { return kind == Kind::uniform || kind == Kind::storage || isCommandInput(kind); }
  bool hasFormat() const { return shape.format != Format::none; }
  bool filters() const {
    return work.sampler.linear || work.sampler.wrap != Wrap::clamp || work.sampler.compare;
  }
  bool mayFilter() const {  // a blit filters too, and says no more
    return kind == Kind::sampled ||
           (kind == Kind::copy && type && type->framebuffers && !isBuffer(shape) && access == Access::read &&
            work.sampler.wrap == Wrap::clamp && !work.sampler.compare);
  }
};

// What a use must fit: the resource, the access, the type of pass, the format. The first rule that is broken is the mistake.
struct UseRule {
  bool (*broken)(const Use& use);
  Code code;
  const char *why, *expected, *hint = "";
};
constexpr UseRule kUseRules[] = {
    {[](const Use& u) { return u.event; }, Code::badKind, "an event holds nothing",
     "a texture or a buffer; name events in \"reset\""},
    {[](const Use& u) { return !isBuffer(u.shape) && u.ofBuffers(); }, Code::badKind, "it is a texture",
     "sampled, image, color, depth or copy for a texture"},
    {[](const Use& u) { return isBuffer(u.shape) && !u.ofBuffers() && u.kind != Kind::copy; }, Code::badKind,
     "it is a buffer", "uniform, storage or copy for a buffer"},
    {[](const Use& u) {
       return u.type && !u.hasShader() && u.kind != defaultKind(u.type, u.access, u.shape);
     },
     Code::badKind, "this type of pass has one way to use it", "no 'as' with a kind"},
    {[](const Use& u) { return u.hasShader() && u.kind == Kind::copy; }, Code::badKind, "it has a shader",
     "a kind that a shader has; copies are made by blit passes"},
    {[](const Use& u) { return u.attaches() && u.shader() == ShaderShape::compute; }, Code::badKind,
     "a compute pass has no attachments", "image"},
    {[](const Use& u) {
       return (u.kind == Kind::sampled || u.kind == Kind::uniform) && u.access != Access::read;
     },
     Code::badKind, "a shader only reads it", "reading only for this kind"},
    {[](const Use& u) { return u.kind == Kind::color && u.access == Access::read; }, Code::badKind,
     "it is only drawn into", "writing or modifying for color"},
    {[](const Use& u) { return isCommandInput(u.kind); }, Code::unusedKind, "no type of pass does so yet",
     "uniform, storage or copy for a buffer", "read it as storage; the shader indexes it"},
    {[](const Use& u) { return u.type && u.filters() && !u.mayFilter(); }, Code::badKind,
     "it is not sampled, so it has no filter",
     "linear, wrap, mirror, border and compare for sampled textures"},
    {[](const Use& u) {
       return u.hasFormat() && u.kind == Kind::color && !infoOf(u.shape.format).colorRenderable;
     },
     Code::badFormat, "its format does not fit", "a format that can be rendered to"},
    {[](const Use& u) {
       return u.hasFormat() && u.kind == Kind::image && !infoOf(u.shape.format).imageStorable;
     },
     Code::badFormat, "its format does not fit", "a format that images can have"},
    {[](const Use& u) { return u.hasFormat() && u.kind == Kind::depth && !isDepth(u.shape.format); },
     Code::badFormat, "its format does not fit", "a depth format"},
    {[](const Use& u) {
       return u.hasFormat() && u.kind == Kind::sampled && u.work.sampler.compare && !isDepth(u.shape.format);
     },
     Code::badFormat, "its format does not fit", "a depth format for compare",
     "name a depth texture, or leave 'compare' out"},
    {[](const Use& u) {
       return u.hasFormat() && u.work.sampler.linear &&
              (isInteger(u.shape.format) || u.work.use.planes == 2 ||
               (u.kind == Kind::copy && isDepth(u.shape.format)));
     },
     Code::badFormat, "its format does not fit", "a format that can be filtered, or no linear",
     "leave 'linear' out"},
    {[](const Use& u) { return u.shape.samples > 1 && u.work.sampler.linear; }, Code::badKind,
     "it has several samples, which are not filtered", "no linear",
     "leave 'linear' out: the shader declares a sampler2DMS and reads one sample by texelFetch"},
    {[](const Use& u) { return u.work.array && u.attaches(); }, Code::badKind,
     "it is an array, and an attachment is one texture", "one element, 'x[0]'"},
};

}  // namespace

bool checkUse(const SlotContext& context, const RefDesc& ref, Access access, const SlotWork& work) {
  const Entity& entity = context.model.entities[work.entity];
  const FlatResource& shape = entity.shape;
  const bool event =
      entity.import != kNone && context.model.graph.imports[entity.import].kind == ImportKind::event;
  const Use use{shape, work.use.kind, access, context.type, work, event};
  const auto rule = std::ranges::find_if(kUseRules, [&](const UseRule& each) { return each.broken(use); });
  if (rule == std::end(kUseRules)) return true;
  const std::string format =
      use.hasFormat() ? fmt::format(", of format {}", infoOf(shape.format).name) : std::string();
  return context.report(
      rule->code, ref.place,
      fmt::format("cannot {} '{}' as {}: {}", nameOf(access), entity.name, nameOf(use.kind), rule->why),
      {.expected = rule->expected, .found = ref.text + format, .hint = rule->hint, .resource = entity.name});
}

namespace {

struct Attachment {
  std::uint32_t width = 1, height = 1, layers = 1, samples = 1;
  friend bool operator==(const Attachment&, const Attachment&) = default;
};

std::string textOf(const Attachment& a, const SlotWork& work) {
  return fmt::format("'{}' of {}x{}, {} layers, {} samples", work.slot->ref.text, a.width, a.height, a.layers,
                     a.samples);
}

bool overlaps(const SlotWork& a, const SlotWork& b) {
  return a.entity == b.entity && a.firstElement < b.firstElement + b.elementCount &&
         b.firstElement < a.firstElement + a.elementCount && overlap(a.use, b.use);
}

bool checkAttachments(const SlotContext& context, const std::vector<SlotWork>& slots) {
  const SlotWork* first = nullptr;
  Attachment all;
  int colors = 0;
  for (const SlotWork& work : slots) {
    if (work.state != SlotWork::State::connected && work.state != SlotWork::State::missing) continue;
    if (work.entity == kNone || (work.use.kind != Kind::color && work.use.kind != Kind::depth)) continue;
    const Entity& entity = context.model.entities[work.entity];
    const FlatResource& shape = entity.shape;
    if (work.use.kind == Kind::color) ++colors;
    const auto side = [&](std::uint32_t texels) { return std::max(1u, texels >> work.use.mip); };
    const Attachment here{side(shape.width), side(shape.height),
                          shape.target == Target::texture_3d ? side(shape.depth) : work.use.layers,
                          shape.samples};
    if (work.use.mips > 1)
      return context.report(Code::attachmentsDiffer, work.slot->ref.place,
                            fmt::format("attaches {} levels of '{}' at once", work.use.mips, entity.name),
                            {.expected = fmt::format("one level, '{}.mip[0]'", work.slot->ref.name),
                             .hint = "name one, or repeat the pass over the levels"});
    if (!first) {
      first = &work;
      all = here;
    }
    if (here != all)
      return context.report(
          Code::attachmentsDiffer, work.slot->ref.place,
          fmt::format("has attachments '{}' and '{}' that differ", first->slot->name, work.slot->name),
          {.expected = "as " + textOf(all, *first), .found = textOf(here, work), .resource = entity.name});
  }
  return colors <= 8 ||
         context.report(Code::attachmentsDiffer, slots[0].slot->place,
                        fmt::format("has {} color attachments", colors), {.expected = "at most 8"});
}

// `a` writes or modifies. False after a report.
bool checkTogether(const SlotContext& context, const SlotWork& a, const SlotWork& b, bool feedback) {
  const std::string& name = context.model.entities[b.entity].name;
  const bool modifies = a.use.access == Access::modify;
  if (b.use.access != Access::read)
    return &b < &a || context.report(Code::writtenTwice, b.slot->ref.place,
                                     fmt::format("writes '{}' by slot '{}' and by slot '{}'",
                                                 b.slot->ref.text, a.slot->name, b.slot->name),
                                     {.hint = "one pass writes a sub-resource once", .resource = name});
  if (b.use.history > 0 || (modifies ? feedback : a.whole)) return true;
  return context.report(
      Code::readAndWritten, b.slot->ref.place,
      fmt::format("reads '{}' and {} '{}' at the same time", b.slot->ref.text,
                  modifies ? "modifies" : "writes", a.slot->ref.text),
      {.hint = !modifies ? "write another level or layer, or read and write the whole resource"
               : a.whole && b.whole
                   ? "say \"write\" instead of \"modify\", or \"feedback\": true, to read its own texel only"
                   : "\"feedback\": true lets a pass read its own texel of what it modifies",
       .resource = name});
}

// ---- the two slots of a pass type without a shader, blit or mipmap: what GL would refuse, or would do in part ----

struct Copy {
  const SlotWork &from, &to;
  const Entity &source, &target;
  bool levels;  // a mipmap reads one level and writes those that follow it

  bool texture() const { return !isBuffer(source.shape); }
  Format format() const { return source.shape.format; }
  Format other() const { return target.shape.format; }
  bool hasFormats() const { return !levels && format() != Format::none && other() != Format::none; }
  bool hasDepth() const { return isDepth(format()) || isDepth(other()); }
  bool hasSamples() const { return source.shape.samples > 1 || target.shape.samples > 1; }
  bool sameSize() const {
    const auto side = [](std::uint32_t a, const SlotWork& work) { return std::max(1u, a >> work.use.mip); };
    return side(source.shape.width, from) == side(target.shape.width, to) &&
           side(source.shape.height, from) == side(target.shape.height, to);
  }
  // Texels of one format are moved as they are; all else renders.
  bool renders() const {
    return hasFormats() && !hasDepth() && (!sameSize() || format() != other() || hasSamples());
  }
  static bool isOneImage(const SlotWork& side, const FlatResource& shape) {
    return side.use.mips == 1 && side.use.layers == 1 && shape.target != Target::texture_3d;
  }
};

struct CopyRule {
  bool (*broken)(const Copy& copy);
  bool target;  // it is the target's mistake
  Code code;
  const char *why, *expected, *hint = "";
};
constexpr const char* kOneImage = "name one, such as 'x.mip[0]', and repeat the pass for the others";
constexpr CopyRule kCopyRules[] = {
    {[](const Copy& c) { return c.from.array; }, false, Code::badSlots, "it is an array",
     "one element, such as 'x[0]'", "repeat the pass over the elements"},
    {[](const Copy& c) { return c.to.array; }, true, Code::badSlots, "it is an array",
     "one element, such as 'x[0]'", "repeat the pass over the elements"},
    {[](const Copy& c) { return c.levels && !c.texture(); }, false, Code::badSlots, "a buffer has no levels",
     "a texture"},
    {[](const Copy& c) {
       return c.levels && (c.from.entity != c.to.entity || c.from.firstElement != c.to.firstElement ||
                           c.from.use.mips != 1 || c.to.use.mip != c.from.use.mip + 1 ||
                           c.from.use.layer != c.to.use.layer || c.from.use.layers != c.to.use.layers);
     },
     true, Code::badSlots, "its levels do not follow the one that is read",
     "\"read\": { \"source\": \"x.mip[0]\" }, \"write\": { \"result\": \"x.mip[1..]\" }"},
    {[](const Copy& c) {
       return c.levels && c.other() != Format::none && (isInteger(c.other()) || hasStencil(c.other()));
     },
     true, Code::badFormat, "its format cannot be filtered", "a format that can be filtered",
     "a fullscreen pass for each level can choose among four texels"},
    {[](const Copy& c) { return isBuffer(c.source.shape) != isBuffer(c.target.shape); }, true, Code::badSlots,
     "one side is a texture and one a buffer", "two textures, or two buffers",
     "a compute pass can move data from one to the other"},
    {[](const Copy& c) { return c.source.shape.kind == ResourceKind::imported_buffer; }, false,
     Code::badSlots, "it is a table of the world", "a buffer of the graph", "read it in a compute pass"},
    {[](const Copy& c) { return !c.texture() && c.source.shape.bytes != c.target.shape.bytes; }, true,
     Code::badSlots, "the buffers differ in size", "as many bytes as the source"},
    {[](const Copy& c) { return !c.levels && c.texture() && !Copy::isOneImage(c.from, c.source.shape); },
     false, Code::badSlots, "it has several levels, layers or slices", "one level and layer of a texture",
     kOneImage},
    {[](const Copy& c) { return !c.levels && c.texture() && !Copy::isOneImage(c.to, c.target.shape); }, true,
     Code::badSlots, "it has several levels, layers or slices", "one level and layer of a texture",
     kOneImage},
    {[](const Copy& c) {
       const auto a = c.source.shape.samples, b = c.target.shape.samples;
       return !c.levels && c.hasSamples() && (!c.sameSize() || (a > 1 && b > 1 && a != b));
     },
     true, Code::badSlots, "the sides differ in size or samples",
     "one size where a texture has several samples, and as many samples, or one"},
    {[](const Copy& c) {
       if (!c.hasFormats()) return false;
       if (c.hasDepth()) return c.format() != c.other();
       return (isInteger(c.format()) || isInteger(c.other())) &&
              infoOf(c.format()).kind != infoOf(c.other()).kind;
     },
     true, Code::badFormat, "the formats do not fit",
     "equal depth formats, or both integer of one sign, or both neither"},
    {[](const Copy& c) { return c.hasFormats() && c.from.use.planes != c.to.use.planes; }, true,
     Code::badSlots, "one side is a stencil", "both the whole, or both '.stencil'"},
    {[](const Copy& c) { return c.renders() && !infoOf(c.format()).colorRenderable; }, false, Code::badFormat,
     "its format cannot be rendered to", "equal formats and sizes, or formats that can be rendered to"},
    {[](const Copy& c) { return c.renders() && !infoOf(c.other()).colorRenderable; }, true, Code::badFormat,
     "its format cannot be rendered to", "equal formats and sizes, or formats that can be rendered to"},
};

bool checkCopy(const SlotContext& context, const std::vector<SlotWork>& slots) {
  const SlotWork *from = nullptr, *to = nullptr;
  for (const SlotWork& work : slots) {
    if (work.slot->ref.optional)
      return context.report(
          Code::badSlots, work.slot->ref.place, fmt::format("cannot do without its '{}'", work.slot->name),
          {.found = work.slot->ref.text,
           .hint = "leave '?' out; disable the pass where there is nothing to copy, or name a list of "
                   "alternatives"});
    if (work.state == SlotWork::State::connected) (work.slot->access == Access::read ? from : to) = &work;
  }
  if (!from || !to) return true;
  const Copy copy{*from, *to, context.model.entities[from->entity], context.model.entities[to->entity],
                  context.type->fromSource};
  const auto rule = std::ranges::find_if(kCopyRules, [&](const CopyRule& each) { return each.broken(copy); });
  if (rule == std::end(kCopyRules)) return true;
  const auto textOf = [](const SlotWork& side, const Entity& entity) {
    const FlatResource& shape = entity.shape;
    return !isBuffer(shape) ? fmt::format("'{}' of {}", side.slot->ref.text, infoOf(shape.format).name)
                            : fmt::format("'{}' of {} bytes", side.slot->ref.text, shape.bytes);
  };
  return context.report(rule->code, (rule->target ? to : from)->slot->ref.place,
                        fmt::format("cannot copy {} to {}: {}", textOf(*from, copy.source),
                                    textOf(*to, copy.target), rule->why),
                        {.expected = rule->expected,
                         .hint = rule->hint,
                         .resource = (rule->target ? copy.target : copy.source).name});
}

}  // namespace

bool checkPassUses(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots) {
  bool good = checkAttachments(context, slots);
  if (context.type && context.type->shader == ShaderShape::none) good = checkCopy(context, slots) && good;
  for (const SlotWork& a : slots) {
    if (a.state != SlotWork::State::connected || a.use.access == Access::read) continue;
    for (const SlotWork& b : slots)
      if (&a != &b && b.state == SlotWork::State::connected && overlaps(a, b))
        if (!good || !checkTogether(context, a, b, desc.feedback)) return false;
  }
  return good;
}

bool checkHistory(const SlotContext& context, const RefDesc& ref, int history, const Entity& entity) {
  const auto depth = static_cast<int>(entity.depth);
  const bool import = entity.kind == ResourceDesc::Kind::import;
  if (!import && history <= depth) return true;
  const Scope& scope = context.names.scope();
  const auto own = scope.resources.find(ref.name);
  if (own != scope.resources.end() && context.model.entities[own->second].badHistory)
    return false;  // the input that asks for it was reported
  const bool input = entity.scope != &scope && ref.name.find('.') == std::string::npos;
  std::string hint = "let a pass write it into a texture or buffer with \"history\", and read that";
  if (!import)
    hint = fmt::format("declare \"history\": {} on '{}'{}", history, entity.name,
                       input ? ", or on this file's input" : "");
  return context.report(Code::noHistory, ref.place,
                        fmt::format("reads '{}', further back than '{}' remembers", ref.text, entity.name),
                        {.expected = depth > 0 ? fmt::format("@-1 to @-{}", depth) : "what has a \"history\"",
                         .hint = std::move(hint),
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
                             graph.passes[slower].cadence == Cadence::once ? "once" : "on change"),
                 {.hint = "read it and write another resource, or give both passes one \"update\"",
                  .resource = context.model.entities[work.entity].name});
}

}  // namespace weft::graph::expansion
