#include "engine/graph/print/format_table.h"

#include <fmt/format.h>

namespace weft::graph {

namespace {

const char* kindName(TexelKind kind) {
  switch (kind) {
    case TexelKind::none:
      return "nothing";
    case TexelKind::normalized:
      return "normalized";
    case TexelKind::floating:
      return "float";
    case TexelKind::unsigned_integer:
      return "unsigned";
    case TexelKind::signed_integer:
      return "signed";
    case TexelKind::depth:
      return "depth";
    case TexelKind::depth_stencil:
      return "depth/stencil";
  }
  return "";
}

}  // namespace

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
  const auto mark = [](bool can) { return can ? "yes" : "-"; };
  std::string text = fmt::format("{:<18}{:>6}{:>9}  {:<18}{:<11}{:<8}{:<9}{}\n", "name", "bytes", "channels",
                                 "texels", "attachment", "blend", "filter", "as image");
  for (const std::string& name : formatNames()) {
    const Format format = *findFormat(name);
    const FormatInfo& info = infoOf(format);
    const FormatUses uses = usesOf(format);
    text += fmt::format("{:<18}{:>6}{:>9}  {:<18}{:<11}{:<8}{:<9}{}\n", name, info.bytes, info.channels,
                        kindName(info.kind), mark(uses.attachment), mark(uses.blended), mark(uses.filtered),
                        uses.image ? name : "-");
  }
  return text;
}

}  // namespace weft::graph
