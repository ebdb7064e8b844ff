// What a texture of each format can be used for. Declared in print.h.
#include <fmt/format.h>

#include "engine/graph/print/print.h"

namespace weft::graph {

FormatUses usesOf(Format format) {
  const FormatInfo& info = infoOf(format);
  const bool whole = info.kind == TexelKind::unsigned_integer || info.kind == TexelKind::signed_integer;
  const bool texels = info.kind != TexelKind::none;
  return {.attachment = info.colorRenderable || isDepth(format),
          .blended = info.colorRenderable && !whole,
          .filtered = texels && !whole,
          .image = info.imageStorable};
}

std::string formatTable() {
  constexpr const char* kKinds[] = {"nothing", "normalized", "float",        "unsigned",
                                    "signed",  "depth",      "depth/stencil"};
  const auto mark = [](bool can) { return can ? "yes" : "-"; };
  std::string text = fmt::format("{:<18}{:>6}{:>9}  {:<18}{:<11}{:<8}{:<9}{}\n", "name", "bytes", "channels",
                                 "texels", "attachment", "blend", "filter", "as image");
  for (const std::string& name : formatNames()) {
    const Format format = *findFormat(name);
    const FormatInfo& info = infoOf(format);
    const FormatUses uses = usesOf(format);
    text += fmt::format("{:<18}{:>6}{:>9}  {:<18}{:<11}{:<8}{:<9}{}\n", name, info.bytes, info.channels,
                        kKinds[static_cast<std::size_t>(info.kind)], mark(uses.attachment),
                        mark(uses.blended), mark(uses.filtered), uses.image ? name : "-");
  }
  return text;
}

}  // namespace weft::graph
