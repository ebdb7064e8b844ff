#include "engine/graph/expand/checks.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/graph/expand/copies.h"

namespace weft::graph::expansion {

bool isTexture(const FlatResource& shape) {
  return shape.kind == ResourceKind::texture || shape.kind == ResourceKind::imported_texture;
}

bool coversAll(const PassType* type, const SlotWork& work) {
  return !type || type->shader != ShaderShape::draw ||
         (work.use.kind != Kind::color && work.use.kind != Kind::depth);
}

bool isInteger(Format format) {
  const TexelKind kind = infoOf(format).kind;
  return kind == TexelKind::unsigned_integer || kind == TexelKind::signed_integer;
}

const PassType* findPassType(const Registry& registry, std::string_view name) {
  for (const PassType& type : registry.passTypes)
    if (type.name == name) return &type;
  return nullptr;
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
  if (!isTexture(shape)) return type->shader == ShaderShape::none ? Kind::copy : Kind::storage;
  if (access == Access::read) return type->defaultReadTexture;
  return type->defaultWriteTexture == Kind::color && isDepth(shape.format) ? Kind::depth
                                                                           : type->defaultWriteTexture;
}

namespace {

// A use, and the words for what is wrong with it.
struct Use {
  const Entity& entity;
  const FlatResource& shape;
  Kind kind;
  Access access;
  const PassType* type;  // null: present, outputs, resets
  const SlotWork& work;

  ShaderShape shader() const { return type ? type->shader : ShaderShape::none; }
  bool hasShader() const { return type && type->shader != ShaderShape::none; }
  bool attaches() const { return kind == Kind::color || kind == Kind::depth; }
  bool ofBuffers() const { return kind == Kind::uniform || kind == Kind::storage || isCommandInput(kind); }
  bool filters() const {
    return work.sampler.linear || work.sampler.wrap != Wrap::clamp || work.sampler.compare;
  }
  bool mayFilter() const {  // a blit filters too, and says no more
    return kind == Kind::sampled ||
           (kind == Kind::copy && type && type->framebuffers && isTexture(shape) && access == Access::read &&
            work.sampler.wrap == Wrap::clamp && !work.sampler.compare);
  }
};

// What a kind must fit: the resource, the access and the type of pass. The first that applies is the mistake.
struct KindRule {
  bool (*broken)(const Use& use);
  const char* expected;  // null: the kind that the type of pass uses
};
constexpr KindRule kKindRules[] = {
    {[](const Use& u) { return isTexture(u.shape) && u.ofBuffers(); },
     "sampled, image, color, depth or copy for a texture"},
    {[](const Use& u) { return !isTexture(u.shape) && !u.ofBuffers() && u.kind != Kind::copy; },
     "uniform, storage or copy for a buffer"},
    {[](const Use& u) {
       return u.type && !u.hasShader() && u.kind != defaultKind(u.type, u.access, u.shape);
     },
     nullptr},
    {[](const Use& u) { return u.hasShader() && u.kind == Kind::copy; },
     "a kind that a shader has; copies are made by blit passes"},
    {[](const Use& u) { return u.attaches() && u.shader() == ShaderShape::compute; },
     "image in a pass without attachments"},
    {[](const Use& u) {
       return (u.kind == Kind::sampled || u.kind == Kind::uniform) && u.access != Access::read;
     },
     "reading only for this kind"},
    {[](const Use& u) { return u.kind == Kind::color && u.access == Access::read; },
     "writing or modifying for color"},
};

// What a format must have, where it is known.
struct FormatRule {
  bool (*broken)(const Use& use);
  const char *expected, *hint;
};
constexpr FormatRule kFormatRules[] = {
    {[](const Use& u) { return u.kind == Kind::color && !infoOf(u.shape.format).colorRenderable; },
     "a format that can be rendered to", ""},
    {[](const Use& u) { return u.kind == Kind::image && !infoOf(u.shape.format).imageStorable; },
     "a format that images can have", ""},
    {[](const Use& u) { return u.kind == Kind::depth && !isDepth(u.shape.format); }, "a depth format", ""},
    {[](const Use& u) {
       return u.kind == Kind::sampled && u.work.sampler.compare && !isDepth(u.shape.format);
     },
     "a depth format for compare", "name a depth texture, or leave 'compare' out"},
    {[](const Use& u) {
       return u.work.sampler.linear && (isInteger(u.shape.format) || u.work.use.planes == 2 ||
                                        (u.kind == Kind::copy && isDepth(u.shape.format)));
     },
     "a format that can be filtered, or no linear", "leave 'linear' out"},
};

}  // namespace

bool checkUse(const SlotContext& context, const RefDesc& ref, Access access, const SlotWork& work) {
  const Entity& entity = context.model.entities[work.entity];
  const Use use{entity, entity.shape, work.use.kind, access, context.type, work};
  const auto report = [&](Code code, std::string message, std::string expected, std::string hint = {}) {
    auto& d = context.model.diagnostics.error(code, ref.place, std::move(message));
    d.pass = context.pass;
    d.resource = entity.name;
    d.expected = std::move(expected);
    d.found = ref.text;
    d.hint = std::move(hint);
    return false;
  };
  if (entity.import != kNone && context.model.graph.imports[entity.import].kind == ImportKind::event)
    return report(Code::badKind,
                  fmt::format("{} uses '{}', which is an event and holds nothing", context.user, entity.name),
                  "a texture or a buffer; name events in \"reset\"");
  for (const KindRule& rule : kKindRules)
    if (rule.broken(use))
      return report(
          Code::badKind,
          fmt::format("{} cannot {} '{}' as {}", context.user, nameOf(access), entity.name, nameOf(use.kind)),
          rule.expected ? rule.expected
                        : fmt::format("a {} pass uses {}", context.type->name,
                                      nameOf(defaultKind(context.type, access, use.shape))));
  if (isCommandInput(use.kind))
    return report(Code::unusedKind,
                  fmt::format("{} uses '{}' as {}, which no type of pass does yet", context.user, entity.name,
                              nameOf(use.kind)),
                  "uniform, storage or copy for a buffer", "read it as storage; the shader indexes it");
  if (context.type && use.filters() && !use.mayFilter())
    return report(Code::badKind,
                  fmt::format("{}: '{}' is not sampled, it has no filter", context.user, entity.name),
                  "linear, wrap, mirror, border and compare for sampled textures");
  for (const FormatRule& rule : kFormatRules)
    if (use.shape.format != Format::none && rule.broken(use))
      return report(Code::badFormat,
                    fmt::format("{}: the format {} of '{}' does not fit the use as {}", context.user,
                                infoOf(use.shape.format).name, entity.name, nameOf(use.kind)),
                    rule.expected, rule.hint);
  if (use.shape.samples > 1 && work.sampler.linear)
    return report(
        Code::badKind,
        fmt::format("{}: '{}' has several samples, it cannot be filtered", context.user, entity.name),
        "no linear",
        "leave 'linear' out: the shader declares a sampler2DMS and reads one sample by texelFetch");
  if (work.array && use.attaches())
    return report(
        Code::badKind,
        fmt::format("{}: '{}' is an array, an attachment is one texture", context.user, entity.name),
        fmt::format("one element, '{}[0]'", entity.name));
  return true;
}

namespace {

struct Attachment {
  const SlotWork* slot;
  std::uint32_t width, height, layers, samples;
};

std::string attachmentText(const Attachment& a) {
  std::string text = fmt::format("{}x{}", a.width, a.height);
  if (a.layers != 1) text += fmt::format(", {} layers", a.layers);
  if (a.samples != 1) text += fmt::format(", {} samples", a.samples);
  return text;
}

bool overlaps(const SlotWork& a, const SlotWork& b) {
  return a.entity == b.entity && a.firstElement < b.firstElement + b.elementCount &&
         b.firstElement < a.firstElement + a.elementCount && overlap(a.use, b.use);
}

bool checkAttachments(const SlotContext& context, const std::vector<SlotWork>& slots) {
  std::optional<Attachment> first;
  int colors = 0;
  for (const SlotWork& work : slots) {
    if (work.state != SlotWork::State::connected && work.state != SlotWork::State::missing) continue;
    if (work.entity == kNone || (work.use.kind != Kind::color && work.use.kind != Kind::depth)) continue;
    const Entity& entity = context.model.entities[work.entity];
    const FlatResource& shape = entity.shape;
    if (work.use.kind == Kind::color) ++colors;
    const auto side = [&](std::uint32_t texels) { return std::max(1u, texels >> work.use.mip); };
    const Attachment here{&work, side(shape.width), side(shape.height),
                          shape.target == Target::texture_3d ? side(shape.depth) : work.use.layers,
                          shape.samples};
    if (work.use.mips > 1) {
      auto& d = context.model.diagnostics.error(
          Code::attachmentsDiffer, work.slot->ref.place,
          fmt::format("{} attaches {} levels of '{}' at once", context.user, work.use.mips, entity.name));
      d.pass = context.pass;
      d.resource = entity.name;
      d.expected = "one level";
      d.hint = fmt::format("write '{}.mip[0]', or repeat the pass over the levels", work.slot->ref.name);
      return false;
    }
    if (!first) {
      first = here;
      continue;
    }
    if (here.width == first->width && here.height == first->height && here.layers == first->layers &&
        here.samples == first->samples)
      continue;
    auto& d =
        context.model.diagnostics.error(Code::attachmentsDiffer, work.slot->ref.place,
                                        fmt::format("{}: attachments '{}' and '{}' differ", context.user,
                                                    first->slot->slot->name, work.slot->name));
    d.pass = context.pass;
    d.resource = entity.name;
    d.expected = fmt::format("{} as '{}'", attachmentText(*first), first->slot->slot->ref.text);
    d.found = fmt::format("{} of '{}'", attachmentText(here), work.slot->ref.text);
    return false;
  }
  if (colors > 8) {
    auto& d =
        context.model.diagnostics.error(Code::attachmentsDiffer, slots[0].slot->place,
                                        fmt::format("{} has {} colour attachments", context.user, colors));
    d.pass = context.pass;
    d.expected = "at most 8";
    return false;
  }
  return true;
}

}  // namespace

bool checkPassUses(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots) {
  bool good = checkAttachments(context, slots);
  if (context.type && context.type->shader == ShaderShape::none) good = checkCopy(context, slots) && good;
  const auto report = [&](Code code, const SlotWork& slot, std::string message, const char* hint) {
    auto& d = context.model.diagnostics.error(code, slot.slot->ref.place, std::move(message));
    d.pass = context.pass;
    d.resource = context.model.entities[slot.entity].name;
    d.hint = hint;
    good = false;
  };
  for (std::size_t i = 0; i < slots.size() && good; ++i) {
    const SlotWork& a = slots[i];
    if (a.state != SlotWork::State::connected || a.use.access == Access::read) continue;
    for (std::size_t j = 0; j < slots.size() && good; ++j) {
      const SlotWork& b = slots[j];
      if (i == j || b.state != SlotWork::State::connected || !overlaps(a, b)) continue;
      const bool modifies = a.use.access == Access::modify;
      if (b.use.access != Access::read) {
        if (j > i)
          report(Code::writtenTwice, b,
                 fmt::format("{} writes '{}' by slot '{}' and by slot '{}'", context.user, b.slot->ref.text,
                             a.slot->name, b.slot->name),
                 "one pass writes a sub-resource once");
      } else if (b.use.history == 0 && (modifies ? !desc.feedback : !a.whole)) {
        // Both attachments of one kind: depth tested by a read slot and modified by another.
        report(Code::readAndWritten, b,
               fmt::format("{} reads '{}' and {} '{}' in one go", context.user, b.slot->ref.text,
                           modifies ? "modifies" : "writes", a.slot->ref.text),
               modifies && a.whole && b.whole
                   ? "say \"write\" instead of \"modify\": the pass then reads the version before it and "
                     "makes the next "
                     "one; or \"feedback\": true, to read its own texel only"
               : modifies ? "\"feedback\": true lets a pass read its own texel of what it modifies"
                          : "write another level or layer, or read and write the whole resource, which makes "
                            "its next version");
      }
    }
  }
  return good;
}

bool checkHistory(const SlotContext& context, const RefDesc& ref, int history, const Entity& entity) {
  const auto depth = static_cast<int>(entity.depth);
  const bool import = entity.kind == ResourceDesc::Kind::import;
  if (!import && history <= depth) return true;
  const auto own = context.names.scope().resources.find(ref.name);
  if (own != context.names.scope().resources.end() && context.model.entities[own->second].badHistory)
    return false;  // the input that asks for it was reported
  auto& d = context.model.diagnostics.error(
      Code::noHistory, ref.place,
      fmt::format("{} reads '{}', further back than '{}' remembers", context.user, ref.text, entity.name));
  d.pass = context.pass;
  d.resource = entity.name;
  if (depth > 0) d.expected = fmt::format("@-1 to @-{}", depth);
  if (d.expected.empty()) d.found = import ? "an import, which has no history" : "no history is declared";
  const bool input = entity.scope != &context.names.scope() && ref.name.find('.') == std::string::npos;
  if (!import)
    d.hint = fmt::format("declare \"history\": {} on '{}'{}", history, entity.name,
                         input ? ", or on this file's input" : "");
  else
    d.hint = "let a pass write it into a texture or buffer with \"history\", and read that";
  return false;
}

void checkAccumulation(const SlotContext& context, const SlotWork& work, std::uint32_t firstUse) {
  const FlatGraph& graph = context.model.graph;
  for (std::uint32_t i = 0; i < work.elementCount; ++i) {
    std::uint32_t slower = kNone;  // the first of those it adds to
    graph.links.forEachWriter(graph.links.seen[firstUse + i], [&](std::uint32_t use) {
      const std::uint32_t writer = graph.links.passOf[use];
      if (slower == kNone && graph.passes[writer].cadence != Cadence::always) slower = writer;
    });
    if (slower == kNone) continue;
    auto& report = context.model.diagnostics.error(
        Code::addsUp, work.slot->ref.place,
        fmt::format("{} runs in every frame and modifies '{}', which '{}' makes only {}", context.user,
                    work.slot->ref.text, graph.passNames[slower],
                    graph.passes[slower].cadence == Cadence::once ? "once" : "on change"));
    report.pass = context.pass;
    report.resource = context.model.entities[work.entity].name;
    report.hint =
        "it would add up from frame to frame: read it and write another resource, or give both passes "
        "one \"update\"";
    return;
  }
}

}  // namespace weft::graph::expansion
