#include "engine/graph/expand/copies.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/graph/expand/checks.h"

namespace weft::graph::expansion {

namespace {

class Copy {
 public:
  Copy(const SlotContext& context, const SlotWork& from, const SlotWork& to)
      : context_(context),
        from_(from),
        to_(to),
        source_(context.model.entities[from.entity]),
        target_(context.model.entities[to.entity]) {}

  bool check() const {
    for (const SlotWork* side : {&from_, &to_})
      if (side->array)
        return refuse(*side, fmt::format("'{}' is an array", nameOf(*side)), "one element",
                      fmt::format("name one, '{}[0]', and repeat the pass", nameOf(*side)));
    if (context_.type->fromSource) return checkLevels();
    if (isTexture(source_.shape) != isTexture(target_.shape))
      return refuse(to_,
                    fmt::format("'{}' is a {}, '{}' a {}", source_.name, kindOf(source_), target_.name,
                                kindOf(target_)),
                    "two textures, or two buffers", "a compute pass can move data from one to the other");
    return isTexture(source_.shape) ? checkTextures() : checkBuffers();
  }

 private:
  static const char* kindOf(const Entity& entity) { return isTexture(entity.shape) ? "texture" : "buffer"; }
  const std::string& nameOf(const SlotWork& side) const { return (&side == &from_ ? source_ : target_).name; }

  bool report(Code code, const SlotWork& side, std::string message, std::string expected,
              std::string hint) const {
    auto& d = context_.model.diagnostics.error(code, side.slot->ref.place,
                                               fmt::format("{}: {}", context_.user, message));
    d.pass = context_.pass;
    d.resource = nameOf(side);
    d.expected = std::move(expected);
    d.hint = std::move(hint);
    return false;
  }
  bool refuse(const SlotWork& side, std::string message, std::string expected, std::string hint = {}) const {
    return report(Code::badSlots, side, std::move(message), std::move(expected), std::move(hint));
  }

  // ---- mipmap ----

  bool checkLevels() const {
    for (const SlotWork* side : {&from_, &to_})
      if (!isTexture(context_.model.entities[side->entity].shape))
        return refuse(*side, fmt::format("'{}' is a buffer, which has no levels", nameOf(*side)),
                      "a texture");
    const bool follows = from_.entity == to_.entity && from_.firstElement == to_.firstElement &&
                         from_.use.mips == 1 && to_.use.mip == from_.use.mip + 1 &&
                         from_.use.layer == to_.use.layer && from_.use.layers == to_.use.layers;
    if (!follows)
      return refuse(
          to_, fmt::format("the levels of '{}' do not follow '{}'", to_.slot->ref.text, from_.slot->ref.text),
          {},
          fmt::format(
              "\"read\": {{ \"source\": \"{0}.mip[0]\" }}, \"write\": {{ \"result\": \"{0}.mip[1..]\" }}",
              to_.slot->ref.name));
    const Format format = target_.shape.format;
    if (format == Format::none || (!isInteger(format) && !hasStencil(format))) return true;
    return report(
        Code::badFormat, to_, fmt::format("'{}' ({}) cannot be filtered", target_.name, infoOf(format).name),
        "a format that can be filtered", "a fullscreen pass for each level can choose among four texels");
  }

  // ---- blit ----

  bool checkBuffers() const {
    if (source_.shape.kind == ResourceKind::imported_buffer)
      return refuse(from_, fmt::format("'{}' is a table of the world", source_.name), "a buffer of the graph",
                    "read it in a compute pass");
    if (source_.shape.bytes == target_.shape.bytes) return true;
    return refuse(to_, fmt::format("'{}' and '{}' differ in size", source_.name, target_.name),
                  fmt::format("{} bytes as '{}'", source_.shape.bytes, source_.name),
                  fmt::format("declare '{}' with \"buffer\": {}", target_.name, source_.shape.bytes));
  }

  static bool isDeep(const FlatResource& shape) { return shape.target == Target::texture_3d; }
  static std::uint32_t widthOf(const SlotWork& side, const FlatResource& shape) {
    return std::max(1u, shape.width >> side.use.mip);
  }
  static std::uint32_t heightOf(const SlotWork& side, const FlatResource& shape) {
    return std::max(1u, shape.height >> side.use.mip);
  }

  bool checkTextures() const {
    const FlatResource &a = source_.shape, &b = target_.shape;
    for (const SlotWork* side : {&from_, &to_}) {
      const FlatResource& shape = side == &from_ ? a : b;
      const std::string& name = side->slot->ref.name;
      if (isDeep(shape))
        return refuse(*side, fmt::format("'{}' is a 3d texture", nameOf(*side)),
                      "one level and layer of a texture", "a compute pass can copy it");
      if (side->use.mips == 1 && side->use.layers == 1) continue;
      const char* part = side->use.mips > 1 ? ".mip[0]" : isCube(shape) ? ".face[0]" : ".layer[0]";
      return refuse(*side,
                    fmt::format("'{}' is {} {}", side->slot->ref.text,
                                side->use.mips > 1 ? side->use.mips : side->use.layers,
                                side->use.mips > 1 ? "levels"
                                : isCube(shape)    ? "faces"
                                                   : "layers"),
                    "one level and layer of a texture",
                    fmt::format("name one, such as '{}{}', and repeat the pass for the others", name, part));
    }
    const bool equal = widthOf(from_, a) == widthOf(to_, b) && heightOf(from_, a) == heightOf(to_, b);
    if ((a.samples > 1 || b.samples > 1) &&
        (!equal || (a.samples > 1 && b.samples > 1 && a.samples != b.samples)))
      return refuse(to_, fmt::format("'{}' and '{}' differ in size or samples", source_.name, target_.name),
                    "one size where a texture has several samples, and as many samples, or one");
    return checkFormats(a, b, equal);
  }

  bool checkFormats(const FlatResource& a, const FlatResource& b, bool equal) const {
    if (a.format == Format::none || b.format == Format::none) return true;
    const bool depth = isDepth(a.format) || isDepth(b.format),
               integer = isInteger(a.format) || isInteger(b.format);
    const bool fits = depth     ? a.format == b.format
                      : integer ? infoOf(a.format).kind == infoOf(b.format).kind
                                : true;
    if (!fits)
      return report(Code::badFormat, to_,
                    fmt::format("'{}' ({}) cannot be copied to '{}' ({})", source_.name,
                                infoOf(a.format).name, target_.name, infoOf(b.format).name),
                    "equal depth formats, or both integer of one sign, or both neither", {});
    if (from_.use.planes != to_.use.planes)
      return refuse(
          to_, fmt::format("'{}' and '{}' are not the same planes", from_.slot->ref.text, to_.slot->ref.text),
          "both the whole, or both '.stencil'");
    // Texels of one format are moved as they are; all else renders.
    const bool moved = equal && a.format == b.format && a.samples == 1 && b.samples == 1;
    for (const SlotWork* side : {&from_, &to_}) {
      const Format format = side == &from_ ? a.format : b.format;
      if (depth || moved || infoOf(format).colorRenderable) continue;
      return report(
          Code::badFormat, *side,
          fmt::format("'{}' ({}) cannot be rendered to, which a copy between formats or sizes needs",
                      nameOf(*side), infoOf(format).name),
          "equal formats and sizes, or formats that can be rendered to", {});
    }
    return true;
  }

  const SlotContext& context_;
  const SlotWork &from_, &to_;
  const Entity &source_, &target_;
};

}  // namespace

bool checkCopy(const SlotContext& context, const std::vector<SlotWork>& slots) {
  const SlotWork *from = nullptr, *to = nullptr;
  for (const SlotWork& work : slots) {
    if (work.slot->ref.optional) {
      auto& d =
          context.model.diagnostics.error(Code::badSlots, work.slot->ref.place,
                                          fmt::format("{}: a {} pass cannot do without its '{}'",
                                                      context.user, context.type->name, work.slot->name));
      d.pass = context.pass;
      d.found = work.slot->ref.text;
      d.hint =
          "leave '?' out; disable the pass where there is nothing to copy, or name a list of alternatives";
      return false;
    }
    if (work.state == SlotWork::State::connected) (work.slot->access == Access::read ? from : to) = &work;
  }
  return !from || !to || Copy(context, *from, *to).check();
}

}  // namespace weft::graph::expansion
