#include "engine/graph/expand/view.h"

#include <fmt/format.h>

#include "engine/graph/expand/checks.h"

namespace weft::graph::expansion {

namespace {

bool givesViews(const Model& model, std::uint32_t import) {
  const ImportSpec& spec = model.graph.imports[import];
  const ImportType* type = findImportType(model.registry, spec.request.type);
  return spec.kind == ImportKind::view || (type && type->views);
}

}  // namespace

std::optional<std::uint32_t> resolveView(const SlotContext& context, const PassDesc& desc, PassSpec& spec) {
  Model& model = context.model;
  if (!desc.view) {
    // Declared under the name of such a type, here or in an enclosing file.
    for (const ImportType& type : model.registry.imports) {
      if (!type.everyPass) continue;
      const std::uint32_t view = findEntity(model, context.names.scope(), type.name, true);
      if (view != kNone && model.entities[view].desc && ensureShape(model, view))
        spec.view = model.entities[view].import;
    }
    return spec.view;
  }
  const RefDesc& ref = *desc.view;
  const auto fail = [&](Code code, std::string message, std::string expected,
                        std::string hint) -> std::optional<std::uint32_t> {
    auto& d = model.diagnostics.error(code, ref.place, fmt::format("{} {}", context.user, message));
    d.pass = context.pass;
    d.found = ref.text;
    d.expected = std::move(expected);
    d.hint = std::move(hint);
    return std::nullopt;
  };
  std::uint32_t found = findEntityOrReport(model, context.names.scope(), ref.name, ref.import, ref.place,
                                           {context.user, "is seen from", context.pass, "view"});
  if (found == kNone || !ensureShape(model, found)) return std::nullopt;
  const Entity& entity = model.entities[found];
  if (entity.kind != ResourceDesc::Kind::import || !givesViews(model, entity.import)) {
    std::string views;
    for (const ImportType& type : model.registry.imports)
      if (type.kind == ImportKind::view || type.views) views += (views.empty() ? "@" : ", @") + type.name;
    return fail(Code::notAView, fmt::format("is seen from '{}', which is no view", ref.text),
                "a view: " + views, "");
  }
  if (ref.optional || ref.condition.present())
    return fail(Code::notAView, fmt::format("is seen from '{}'", ref.text), "a view without '?' and 'if'",
                fmt::format("\"enabled\": \"has({})\" leaves the pass out where there is none", ref.name));
  if (ref.mip || ref.layer || ref.stencil || ref.history || ref.wordsSize > 0)
    return fail(Code::notAView, fmt::format("is seen from '{}'", ref.text),
                "a view, perhaps with [element] and .face", "");
  if (context.versions && !entity.exists)
    return fail(Code::emptyImport, fmt::format("is seen from '{}', which the scene does not have", ref.text),
                "", fmt::format("\"enabled\": \"has({})\" leaves the pass out then", ref.name));
  if (ref.element) {
    const std::int64_t last =
        entity.count > 0 && context.ranges ? static_cast<std::int64_t>(entity.count) - 1 : 65535;
    const auto element = evaluateWhole(context.names, *ref.element, 0, 0, last, "the element of the view");
    if (!element) return std::nullopt;
    spec.viewLayer = static_cast<std::uint16_t>(*element);
  }
  if (ref.face) {
    const auto face = evaluateWhole(context.names, ref.face->first, 0, 0, 5, "the face of the view");
    if (!face || ref.face->range)
      return face
                 ? fail(Code::notAView, "is seen from several faces", "one face", "repeat the pass over them")
                 : std::nullopt;
    spec.viewFace = static_cast<std::uint16_t>(*face);
  }
  spec.view = entity.import;
  return spec.view;
}

}  // namespace weft::graph::expansion
