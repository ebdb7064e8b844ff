#include "engine/graph/expand/first_value.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/graph/expand/checks.h"
#include "engine/graph/expand/names/versions.h"
#include "engine/graph/subresource.h"

namespace weft::graph::expansion {

namespace {

// What a sampler type of GLSL is about.
enum class Numbers : std::uint8_t { real, natural, whole };

Numbers numbersOf(Format format) {
  const TexelKind kind = infoOf(format).kind;
  return kind == TexelKind::unsigned_integer ? Numbers::natural
         : kind == TexelKind::signed_integer ? Numbers::whole
                                             : Numbers::real;
}

std::string sizeText(const FlatResource& shape, std::uint32_t mip, std::uint32_t layers) {
  std::string text =
      fmt::format("{}x{}", std::max(1u, shape.width >> mip), std::max(1u, shape.height >> mip));
  if (shape.target == Target::texture_3d) text += fmt::format("x{}", std::max(1u, shape.depth >> mip));
  if (layers != 1) text += fmt::format(", {} layers", layers);
  if (shape.samples != 1) text += fmt::format(", {} samples", shape.samples);
  return text;
}

struct Misfit {
  std::string expected, found;  // empty: none
};

// `work` reads the history, `first` is the whole of what stands in for it.
Misfit misfitOf(const FlatResource& mine, const SlotWork& work, const FlatResource& theirs,
                const SlotWork& first) {
  if (first.array) return {"one texture", "an array; an element of it is written 'x[0]'"};
  if (first.use.history > 0) return {"what it holds in this frame", "an earlier publication, by a list"};
  if (isTexture(mine) != isTexture(theirs))
    return {isTexture(mine) ? "a texture" : "a buffer", isTexture(theirs) ? "a texture" : "a buffer"};
  if (!isTexture(mine)) {
    if (theirs.kind == ResourceKind::imported_buffer)
      return {"a buffer of the graph", "a table of the world"};
    if (theirs.bytes >= mine.bytes) return {};
    return {fmt::format("at least {} bytes", mine.bytes), fmt::format("{} bytes", theirs.bytes)};
  }
  const bool cube = isCube(theirs) && first.use.layers % 6 == 0;
  if (isCube(mine) != cube) return {isCube(mine) ? "a cube" : "no cube", cube ? "a cube" : "no cube"};
  if (work.use.kind == Kind::depth) return {"a number, where a pass tests against the history", "a texture"};
  const std::string wanted = sizeText(mine, 0, mine.layers),
                    given = sizeText(theirs, first.use.mip, first.use.layers);
  if (wanted != given) return {wanted, given};
  if (work.use.mip >= first.use.mips)
    return {fmt::format("level {}, which is read", work.use.mip), fmt::format("{} levels", first.use.mips)};
  const bool sampled = work.use.kind == Kind::sampled && work.use.planes == 1;
  const bool depths = !work.sampler.compare || isDepth(theirs.format);
  if (sampled ? numbersOf(mine.format) == numbersOf(theirs.format) && depths : mine.format == theirs.format)
    return {};
  return {sampled && depths ? fmt::format("numbers of the kind of {}", infoOf(mine.format).name)
          : sampled         ? "a depth format, as the reader compares"
                            : fmt::format("{}, as it is not only sampled", infoOf(mine.format).name),
          infoOf(theirs.format).name};
}

// For `work`, a slot that reads @-n: the same part of what `first` of the resource names, read in the same way. Is not
// `connected` when `first` is a value, when its "?" left nothing, and after a report. `slot` is filled in.
SlotWork resolveFirst(const SlotContext& context, const SlotWork& work, std::uint32_t pass, SlotDesc& slot) {
  Model& model = context.model;
  Entity& entity = model.entities[work.entity];
  if (!entity.firstRef) return {};
  const RefDesc& ref = *entity.firstRef;
  slot = {work.slot->name, ref.place, Access::read, ref};
  slot.ref.kind = work.use.kind;
  Names names(model, *entity.firstScope);
  const SlotContext inside{
      model, names, context.type, context.user, context.pass, context.versions, context.ranges, context.room};
  const std::size_t missed = model.missing.size();
  SlotWork first = resolveSlot(inside, slot, pass);
  if (model.missing.size() > missed) model.missing.back().first = true;
  if (first.state != SlotWork::State::connected) return {};

  const Entity& source = model.entities[first.entity];
  const Misfit misfit = misfitOf(entity.shape, work, source.shape, first);
  if (!misfit.expected.empty()) {
    auto& d = model.diagnostics.error(Code::badFormat, ref.place,
                                      fmt::format("'{}' cannot be the first value of '{}', as {} reads it",
                                                  ref.text, entity.name, context.user));
    d.pass = context.pass;
    d.resource = entity.name;
    d.expected = misfit.expected;
    d.found = misfit.found;
    d.hint = "let a pass write a texture of that size and format, with \"update\": \"once\", and name that";
    return {};
  }
  entity.firstUse = first.use;
  entity.firstUse.resource = currentResource(model, first.entity, first.firstElement);
  if (isTexture(source.shape)) {
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

}  // namespace

void FirstValues::resolve(const SlotContext& context, const std::vector<SlotWork>& slots,
                          std::uint32_t pass) {
  works_.clear();
  slots_.clear();
  const auto reads = [](const SlotWork& work) {
    return work.state == SlotWork::State::connected && work.use.history > 0;
  };
  slots_.reserve(static_cast<std::size_t>(std::ranges::count_if(slots, reads)));  // none of them may move
  for (const SlotWork& work : slots) {
    if (!reads(work)) continue;
    SlotWork first = resolveFirst(context, work, pass, slots_.emplace_back());
    if (first.state == SlotWork::State::connected) works_.emplace_back(work.slot, std::move(first));
  }
}

const std::vector<SlotWork>& FirstValues::with(const std::vector<SlotWork>& slots) {
  if (works_.empty()) return slots;
  all_ = slots;
  for (const auto& [slot, first] : works_) all_.push_back(first);
  return all_;
}

void FirstValues::emit(Model& model, const SlotWork& work, std::uint32_t pass, SlotSpec& spec) const {
  for (const auto& [slot, first] : works_) {
    if (slot != work.slot) continue;
    spec.firstValue = static_cast<std::uint32_t>(model.graph.uses.size());
    addUse(model, first.entity, first.firstElement, first.use, pass);
  }
}

}  // namespace weft::graph::expansion
