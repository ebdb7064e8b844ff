// Imports: their arguments, and what the registry says of them. Declared in resources.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>

#include "engine/base/nearest.h"
#include "engine/base/words/foreign_words.h"
#include "engine/graph/expand/names/apply_settings.h"
#include "engine/graph/expand/names/resources.h"

namespace weft::graph::expansion {

namespace {

bool evaluateArgument(Model& model, Names& names, const Entity& entity, const ImportArgument& argument,
                      const Expr& expr, Value& out) {
  out = expr.evaluate(names, model.diagnostics);
  if (out.type == Value::Type::none) return false;
  const auto report = [&](std::string expected, std::string hint) {
    auto& d = model.diagnostics.error(
        Code::badImportArgument, expr.place(),
        fmt::format("import '{}': argument '{}' does not fit", entity.name, argument.name));
    d.resource = entity.name;
    d.expected = std::move(expected);
    d.found = toText(out);
    d.hint = std::move(hint);
    return false;
  };
  if (argument.drawList && out.type == Value::Type::symbol) {
    const auto& lists = model.registry.drawLists;
    if (std::find(lists.begin(), lists.end(), out.symbol) == lists.end()) {
      auto& d = model.diagnostics.error(
          Code::unknownDrawList, expr.place(),
          fmt::format("import '{}' names the unknown draw list '{}'", entity.name, out.symbol));
      d.hint = base::nearestHint(out.symbol, lists);
      return false;
    }
  }
  if (!argument.choices.empty()) {
    std::string all;
    for (const std::string& choice : argument.choices) all += (all.empty() ? "" : ", ") + choice;
    if (out.type != Value::Type::symbol ||
        std::find(argument.choices.begin(), argument.choices.end(), out.symbol) == argument.choices.end())
      return report("one of " + all, base::nearestHint(out.symbol, argument.choices));
  }
  const Value& initial = argument.initial;
  if (initial.type == Value::Type::none) return true;
  const bool fits = initial.isNumeric() ? out.isNumeric()
                                        : initial.type == out.type && (initial.type != Value::Type::list ||
                                                                       initial.count == out.count);
  if (fits) return true;
  return report(initial.isNumeric()                 ? "a number"
                : initial.type == Value::Type::list ? fmt::format("a list of {}", initial.count)
                                                    : "a word",
                "");
}

}  // namespace

std::string hintForImport(std::string_view name, const std::vector<std::string>& types) {
  for (const base::Foreign kind : {base::Foreign::value, base::Foreign::import_type})
    if (std::string foreign = base::hintForForeign(kind, name); !foreign.empty()) return foreign;
  std::string hint = base::nearestHint(name, types);
  return hint.empty() ? fmt::format("imports are {}", fmt::join(types, ", ")) : hint;
}

bool evaluateImport(Model& model, Entity& entity) {
  const std::string typeName = entity.desc ? entity.desc->import.type : entity.name.substr(1);
  const ImportType* type = findImportType(model.registry, typeName);
  if (!type) {
    std::vector<std::string> types;
    for (const ImportType& known : model.registry.imports) types.push_back(known.name);
    auto& d = model.diagnostics.error(
        Code::unknownImport, entity.desc->place,
        fmt::format("resource '{}' is of the unknown import '{}'", entity.name, typeName));
    d.resource = entity.name;
    d.hint = hintForImport(typeName, types);
    return false;
  }
  ImportRequest request;
  request.type = typeName;
  static const std::vector<NamedExpr> kNoArguments;
  const std::vector<NamedExpr>& given = entity.desc ? entity.desc->import.arguments : kNoArguments;
  Names names(model, *entity.scope);
  bool good = true;
  for (const NamedExpr& argument : given) {
    markStructural(model, *entity.scope, argument.expr);
    if (std::any_of(type->arguments.begin(), type->arguments.end(),
                    [&](const ImportArgument& a) { return a.name == argument.name; }))
      continue;
    std::vector<std::string> known;
    for (const ImportArgument& a : type->arguments) known.push_back(a.name);
    auto& d =
        model.diagnostics.error(Code::badImportArgument, argument.place,
                                fmt::format("import '{}' has no argument '{}'", typeName, argument.name));
    d.resource = entity.name;
    d.hint = base::nearestHint(argument.name, known);
    if (std::string theirs = base::hintForForeign(base::Foreign::import_argument, argument.name);
        !theirs.empty() && std::ranges::find(known, "file") != known.end())
      d.hint = std::move(theirs);
    good = false;
  }
  for (const ImportArgument& argument : type->arguments) {
    const auto found =
        std::find_if(given.begin(), given.end(), [&](const NamedExpr& g) { return g.name == argument.name; });
    Value value = argument.initial;
    if (found != given.end()) {
      good = evaluateArgument(model, names, entity, argument, found->expr, value) && good;
    } else if (argument.initial.type == Value::Type::none) {
      if (!good) continue;  // one misspelling is one mistake
      auto& d = model.diagnostics.error(
          Code::badImportArgument, entity.desc ? entity.desc->place : Place{},
          fmt::format("import '{}' needs the argument '{}'", typeName, argument.name));
      d.resource = entity.name;
      if (!entity.desc)
        d.hint = fmt::format("declare it: \"{}\": {{ \"import\": \"{}\", \"{}\": … }}", typeName, typeName,
                             argument.name);
      good = false;
    }
    request.arguments.emplace_back(argument.name, std::move(value));
  }
  if (!good) return false;
  const ImportFacts facts = model.registry.factsOf ? model.registry.factsOf(request) : ImportFacts{};
  for (const base::Diagnostic& problem : facts.problems) {
    base::Diagnostic& d = model.diagnostics.add(placedAtArgument(model, *entity.scope, given, problem));
    d.resource = entity.name;
    // When a file may not be read, what matters is who names it.
    if (d.code == Code::outsideConfinement && d.place.line == 0 && entity.desc) d.place = entity.desc->place;
    if (!isKnown(d.place) && entity.desc) d.place = entity.desc->place;  // of the arguments
    good = good && problem.severity != base::Severity::error;
  }
  if (!good) return false;
  entity.exists = facts.exists;
  entity.fallback = facts.fallback;
  entity.count = facts.count;
  FlatResource& shape = entity.shape;
  shape.kind =
      type->kind == ImportKind::texture ? ResourceKind::imported_texture : ResourceKind::imported_buffer;
  shape.format = facts.format;
  shape.width = std::max(1u, facts.width);
  shape.height = std::max(1u, facts.height);
  shape.depth = std::max(1u, facts.depth);
  shape.layers = static_cast<std::uint16_t>(std::clamp(facts.layers, 1u, kMaxLayers));
  shape.mips = static_cast<std::uint16_t>(std::clamp(facts.mips, 1u, kMaxMips));
  shape.bytes = facts.bytes;
  shape.target = shape.depth > 1                     ? Target::texture_3d
                 : shape.layers > 1 || facts.layered ? Target::texture_2d_array
                                                     : Target::texture_2d;
  // The elements of an array stand side by side in FlatGraph::imports.
  entity.arrayCount = type->array;
  entity.elements.resize(std::max(1u, type->array));
  for (std::uint32_t element = 0; element < entity.elements.size(); ++element) {
    ImportRequest one = request;
    if (type->array > 0) one.arguments.emplace_back("element", Value::number(element));
    const std::uint32_t import = internImport(model, std::move(one), type->kind, entity.name);
    if (element == 0) entity.import = import;
    assert(import == entity.import + element);
    ImportSpec& spec = model.graph.imports[import];
    spec.count = facts.count;
    spec.changing = facts.changing;
    if (!spec.place.file && entity.desc) spec.place = entity.desc->place;
  }
  shape.import = entity.import;
  return true;
}

const ImportType* findImportType(const Registry& registry, std::string_view name) {
  for (const ImportType& type : registry.imports)
    if (type.name == name) return &type;
  return nullptr;
}

std::uint32_t internImport(Model& model, ImportRequest request, ImportKind kind, const std::string& name) {
  auto& imports = model.graph.imports;
  const std::uint64_t key = keyOf(request);
  const auto [known, fresh] = model.importIndex.try_emplace(key, static_cast<std::uint32_t>(imports.size()));
  if (!fresh) return known->second;
  const ImportType* type = findImportType(model.registry, request.type);
  imports.push_back({.request = std::move(request),
                     .key = key,
                     .kind = kind,
                     .name = name,
                     .columns = type ? type->columns : std::vector<TableColumn>{},
                     .standIns = {}});
  model.importResource.push_back(kNone);
  return static_cast<std::uint32_t>(imports.size() - 1);
}

}  // namespace weft::graph::expansion
