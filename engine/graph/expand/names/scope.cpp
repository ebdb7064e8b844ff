#include "engine/graph/expand/names/scope.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "engine/base/nearest.h"
#include "engine/graph/expand/names/limits.h"
#include "engine/graph/expand/names/names.h"
#include "engine/graph/expand/names/resources.h"
#include "engine/graph/expand/names/unread.h"
#include "engine/graph/language/suffix.h"

namespace weft::graph::expansion {

namespace {

// An optional input that nobody binds, where the including file has nothing of its name.
bool isLeftOut(Model& model, const Entity& entity) {
  if (!entity.desc->optional) return false;
  const Scope& scope = *entity.scope;
  if (!scope.parent) return true;
  const auto& binds = scope.stanza->include->binds;
  const bool bound =
      std::ranges::any_of(binds, [&](const auto& bind) { return bind.first == entity.desc->name; });
  return !bound && !scope.parent->resources.contains(entity.desc->name) &&
         findEntity(model, *scope.parent, entity.desc->name, false) == kNone;
}

// Whether an import may be bound to an input for a buffer or for a texture. An unknown import is reported where it stands.
bool fitsInput(const Model& model, const Entity& import, bool wantsBuffer) {
  const ImportType* type =
      findImportType(model.registry, import.desc ? import.desc->import.type : import.name.substr(1));
  return !type || (type->kind == ImportKind::texture) != wantsBuffer;
}

// Follows inputs to what is bound. kNone after a report.
std::uint32_t followInput(Model& model, std::uint32_t index) {
  Entity& entity = model.entities[index];
  if (entity.kind != ResourceDesc::Kind::input) return index;
  if (entity.bindState == Progress::done || entity.bindState == Progress::failed) return entity.bound;
  if (entity.bindState == Progress::active) {
    reportCycle(model, entity.desc->place, fmt::format("input '{}' stands for itself", entity.name));
    entity.bindState = Progress::failed;
    return kNone;
  }
  const Descent descent(model, 0, entity.desc->place, entity.name);
  if (!descent.good()) {
    entity.bindState = Progress::failed;
    return kNone;
  }
  entity.bindState = Progress::active;
  Scope& scope = *entity.scope;
  const std::string& name = entity.desc->name;
  std::uint32_t target = kNone;
  if (isLeftOut(model, entity)) {
    entity.kind = ResourceDesc::Kind::alternatives;  // a list of none
    entity.listState = Progress::done;
    target = index;
  } else if (!scope.parent) {
    // reportToInclude said so.
  } else {
    const RefDesc* bind = nullptr;
    for (const auto& [input, ref] : scope.stanza->include->binds)
      if (input == name) bind = &ref;
    if (bind) {
      target = findEntityOrReport(model, *scope.parent, bind->name, bind->import, bind->place,
                                  fmt::format("include '{}' binds '{}' to", scope.stanza->include->as, name));
    } else {
      target = findEntity(model, *scope.parent, name, false);
      // One of the includer's own that has nothing behind it was reported there.
      if (target == kNone && !scope.parent->resources.contains(name)) {
        auto& d = model.diagnostics.error(Code::unboundInput, scope.stanza->place,
                                          fmt::format("include '{}' leaves the input '{}' without a resource",
                                                      scope.stanza->include->as, name));
        d.resource = entity.name;
        d.expected =
            fmt::format("a resource '{}' in the including file, or \"bind\": {{ \"{}\": … }}", name, name);
        d.hint = base::nearestHint(name, resourceNames(model, *scope.parent));
      }
    }
  }
  if (target != kNone && target != index) {
    const Entity& bound = model.entities[target];
    const bool wantsBuffer = entity.desc->input == "buffer";
    const bool fits = bound.kind == ResourceDesc::Kind::texture  ? !wantsBuffer
                      : bound.kind == ResourceDesc::Kind::buffer ? wantsBuffer
                      : bound.kind == ResourceDesc::Kind::import ? fitsInput(model, bound, wantsBuffer)
                                                                 : true;
    if (!fits) {
      auto& d = model.diagnostics.error(
          Code::badBind, scope.stanza->place,
          fmt::format("input '{}' is a {}, '{}' is not", entity.name, entity.desc->input, bound.name));
      d.resource = bound.name;
      target = kNone;
    }
  }
  entity.bound = target;
  entity.bindState = target == kNone ? Progress::failed : Progress::done;
  return target;
}

// An import declared under `name` here or in an enclosing file.
std::uint32_t declaredImport(Model& model, Scope& from, std::string_view name) {
  for (Scope* scope = &from; scope; scope = scope->parent)
    if (const auto found = scope->resources.find(name); found != scope->resources.end())
      if (model.entities[found->second].kind == ResourceDesc::Kind::import) return found->second;
  return kNone;
}

}  // namespace

std::uint32_t implicitImport(Model& model, std::string_view type) {
  if (const auto found = model.implicitImports.find(type); found != model.implicitImports.end())
    return found->second;
  if (!findImportType(model.registry, type)) return kNone;
  const auto index = static_cast<std::uint32_t>(model.entities.size());
  assert(index < model.entities.capacity());
  Entity& entity = model.entities.emplace_back();
  entity.kind = ResourceDesc::Kind::import;
  entity.scope = &model.scopes[0];
  entity.name = "@" + std::string(type);
  model.implicitImports.emplace(std::string(type), index);
  return index;
}

std::uint32_t findEntity(Model& model, Scope& scope, std::string_view name, bool import) {
  if (!name.empty() && name[0] == '@') return findEntity(model, scope, name.substr(1), true);
  if (import) {
    if (name.find('.') == std::string_view::npos) {
      const std::uint32_t declared = declaredImport(model, scope, name);
      return declared != kNone ? declared : implicitImport(model, name);
    }
    const std::uint32_t dotted = findEntity(model, scope, name, false);
    return dotted != kNone && model.entities[dotted].kind == ResourceDesc::Kind::import ? dotted : kNone;
  }
  if (const auto found = scope.resources.find(name); found != scope.resources.end())
    return followInput(model, found->second);
  const std::size_t dot = name.find('.');
  if (dot == std::string_view::npos) return kNone;
  const auto child = scope.includes.find(name.substr(0, dot));
  return child == scope.includes.end() ? kNone
                                       : findEntity(model, *child->second, name.substr(dot + 1), false);
}

bool maySuggest(Model& model, std::size_t names) {
  constexpr std::uint64_t kMostNames = 200'000;
  model.effort.suggested += names;
  return model.effort.suggested <= kMostNames;
}

std::vector<std::string> resourceNames(Model& model, const Scope& scope) {
  std::vector<std::string> names;
  if (!maySuggest(model, model.entities.size())) return names;
  for (const Entity& entity : model.entities)
    if (entity.desc && entity.name.starts_with(scope.prefix))
      names.push_back(entity.name.substr(scope.prefix.size()));
  return names;
}

static std::string hintForView(std::string_view name) {
  return fmt::format("declare it: \"resources\": {{ \"{}\": {{ \"import\": \"camera\" }} }}", name);
}

std::uint32_t findEntityOrReport(Model& model, Scope& scope, std::string_view name, bool import,
                                 const Place& place, const Called& user, const std::string& pass,
                                 std::string_view slot, bool orPass) {
  const std::size_t before = model.diagnostics.errorCount();
  const std::uint32_t found = findEntity(model, scope, name, import);
  if (found == kNone && (model.effort.tooDeep || isOver(model))) return kNone;
  if (found != kNone || model.diagnostics.errorCount() > before) return found;
  if (isUnread(scope, name)) return kNone;  // the reader reported its declaration
  if (!isPicturePath(name) && isUnincluded(model, scope, name, place, user.text(), pass)) return kNone;
  // An input with nothing behind it was reported where it stands.
  if (!import && scope.resources.contains(name)) return kNone;
  if (import) {
    auto& d = model.diagnostics.error(Code::unknownImport, place,
                                      fmt::format("{} unknown import '@{}'", user.text(), name));
    std::vector<std::string> types;
    for (const ImportType& type : model.registry.imports) types.push_back(type.name);
    d.resource = "@" + std::string(name);
    d.pass = pass;
    d.hint = scope.resources.contains(name)
                 ? fmt::format("'{}' is a resource of this graph: write it without the @", name)
                 : hintForImport(name, types);
    if (slot == "view" && d.hint.starts_with("imports are")) d.hint = hintForView(name);
    return kNone;
  }
  auto& d = model.diagnostics.error(Code::unknownResource, place,
                                    fmt::format("{} unknown resource '{}'", user.text(), name));
  d.resource = std::string(name);
  d.pass = pass;
  d.hint = hintForResource(model, scope, name, slot == "view" ? "" : slot, orPass, place);
  if (slot == "view" && !d.hint.starts_with("did you mean"))
    d.hint = "write '@camera', or " + hintForView(name);
  return kNone;
}

Variable findVariableFrom(Scope& from, std::string_view name) {
  for (Scope* scope = &from; scope; scope = scope->parent) {
    Scope* at = scope;
    std::string_view rest = name;
    while (true) {
      if (const auto found = at->variables.find(rest); found != at->variables.end()) return found->second;
      const std::size_t dot = rest.find('.');
      if (dot == std::string_view::npos) break;
      const auto child = at->includes.find(rest.substr(0, dot));
      if (child == at->includes.end()) break;
      at = child->second;
      rest = rest.substr(dot + 1);
    }
  }
  return {};
}

Variable findVariable(Model& model, Scope& from, std::string_view name) {
  using Kind = Variable::Kind;
  if (const Variable found = findVariableFrom(from, name); found.kind != Kind::none) return found;
  const auto leaves = model.parametersByLeaf.find(name.substr(name.rfind('.') + 1));
  if (leaves == model.parametersByLeaf.end()) return {};
  Variable result;
  if (!compare(model, leaves->second.count, from.desc->place)) return {};
  for (std::uint32_t index = leaves->second.first; index != kNone;
       index = model.parameters[index].nextOfLeaf) {
    const std::string& path = model.parameters[index].path;
    if (!path.starts_with(from.prefix) || !hasSuffix(path, name)) continue;
    if (result.kind != Kind::none) return {Kind::ambiguous, result.index};
    result = {Kind::parameter, index};
  }
  return result;
}

Parameter* findPassParameter(Model& model, const Scope& scope, const std::string& pass,
                             const std::string& name) {
  const auto found = scope.variables.find(pass + "." + name);
  const bool known = found != scope.variables.end() && found->second.kind == Variable::Kind::parameter;
  return known ? &model.parameters[found->second.index] : nullptr;
}

const PassDesc* findPass(const Scope& scope, std::string_view name) {
  for (const PassDesc& pass : scope.desc->passes)
    if (!pass.include && pass.name == name) return &pass;
  return nullptr;
}

AskedPass findAskedPass(const Scope& scope, std::string_view name) {
  const Scope* at = &scope;
  for (std::size_t dot = name.find('.'); dot != std::string_view::npos; dot = name.find('.')) {
    const auto child = at->includes.find(name.substr(0, dot));
    if (child == at->includes.end()) return {};
    at = child->second;
    name = name.substr(dot + 1);
  }
  const PassDesc* pass = findPass(*at, name);
  return {pass, pass ? at : nullptr};
}

bool checkExpr(Model& model, Scope& scope, const Expr& expr, bool dynamicAllowed,
               std::span<const RangeDesc> repeat) {
  if (!expr.present() || expr.isConstant()) return true;
  const std::size_t before = model.diagnostics.errorCount();
  Names names(model, scope, dynamicAllowed);
  for (const RangeDesc& range : repeat) names.indices.push_back({range.index, 0});
  expr.check(names, model.diagnostics);
  for (const auto& [fact, name] : expr.facts()) {
    if (findEntity(model, scope, name, false) != kNone || implicitImport(model, name) != kNone) continue;
    if (fact == Fact::has && findAskedPass(scope, name).desc) continue;
    const std::size_t known = model.diagnostics.errorCount();
    findEntityOrReport(model, scope, name, name.starts_with("@"), expr.place(), kAsksOf, {}, {},
                       fact == Fact::has);
    if (model.diagnostics.errorCount() > known) model.unknownFacts.emplace(&scope, name);
  }
  return model.diagnostics.errorCount() == before;
}

}  // namespace weft::graph::expansion
