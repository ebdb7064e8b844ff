// What may stand at the cursor in a shader.
#include <fmt/format.h>

#include "app/lsp/answers/items.h"
#include "engine/graph/language/names.h"
#include "engine/runtime/prepare/program_request.h"

namespace weft::app::lsp {

// Offers the slots, parameters and defines of the shader's passes, and HAS_… of slots and parameters.
Json completionInGlsl(const Context& context, const Text& text, std::size_t offset) {
  Range range{offset, offset};
  const std::string_view all = text.bytes();
  while (range.begin > 0 && graph::isIdentChar(all[range.begin - 1])) --range.begin;
  while (range.end < all.size() && graph::isIdentChar(all[range.end])) ++range.end;
  Json items = Json::array();
  std::set<std::string> seen;
  const auto add = [&](const std::string& label, ItemKind kind, const std::string& detail) {
    if (seen.insert(label).second)
      items.push_back({{"label", label},
                       {"kind", static_cast<int>(kind)},
                       {"detail", detail},
                       {"textEdit", {{"range", toJson(text.map(), range)}, {"newText", label}}}});
  };
  for (const Project::Program& program : context.project.programsWith({text.path()}))
    for (const Mention& mention : program.graph->mentions) {
      const bool slot = mention.kind == Mention::Kind::slot,
                 parameter = mention.kind == Mention::Kind::parameter;
      if (mention.pass != program.stanza || (!slot && !parameter && mention.kind != Mention::Kind::define))
        continue;
      const JsonValue* const pass = nameOf(*program.stanza);
      const std::string detail = fmt::format("{} of pass '{}'",
                                             slot        ? "slot"
                                             : parameter ? "parameter"
                                                         : "define",
                                             pass ? pass->text : "");
      add(mention.name, slot ? ItemKind::field : ItemKind::property, detail);
      if (slot || parameter)
        add(runtime::presenceDefineOf(mention.name), ItemKind::keyword, "1 where the pass has it");
    }
  return {{"isIncomplete", false}, {"items", std::move(items)}};
}

}  // namespace weft::app::lsp
