#include "engine/graph/expand/judge/unused.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_map>

#include "engine/graph/desc_walk.h"
#include "engine/graph/expand/names/scope.h"
#include "engine/graph/language/expr_node.h"

namespace weft::graph::expansion {

namespace {

// Which levels, layers or elements all references to a resource select.
struct Selected {
  bool several = false;
  std::string one;  // the only one so far, as written; empty: no reference so far

  void add(const std::string& which) {
    several = several || which.empty() || (!one.empty() && one != which);
    one = which;
  }
};

struct Parts {
  Selected level, layer, element;
};

// The number that a selector names, or empty: all of them, several, or one that depends on something.
std::string onlyOf(const Expr& expr) {
  return expr.present() && expr.isConstant() ? expr.text() : std::string();
}
std::string onlyOf(const std::optional<SpanDesc>& span) {
  if (!span) return {};
  const std::string first = onlyOf(span->first);
  return !span->range || first == onlyOf(span->last) ? first : std::string();
}

// What the expressions and references of all files name.
class Uses {
 public:
  explicit Uses(Model& model) : model_(model) {
    for (Scope& scope : model_.scopes) addFile(scope);
    std::ranges::sort(variables_);
  }

  bool reads(const ParameterDesc& parameter) const {
    return std::ranges::binary_search(variables_, static_cast<const void*>(&parameter)) ||
           below_.contains(parameter.name);
  }
  bool reads(const NamedExpr& let) const {
    return std::ranges::binary_search(variables_, static_cast<const void*>(&let));
  }
  // Null when nothing refers to it.
  const Parts* partsOf(const ResourceDesc& resource) const {
    const auto found = parts_.find(&resource);
    return found == parts_.end() ? nullptr : &found->second;
  }

 private:
  void addFile(Scope& scope) {
    visitMentions(
        *scope.desc, [&](const Expr& expr) { add(scope, expr); },
        [&](const RefDesc& ref) { add(scope, ref); });
  }

  void add(Scope& scope, const Expr& expr) {
    if (!expr.present() || expr.isConstant()) return;
    for (const std::string& name : variablesOf(expr)) {
      const Variable found = findVariableFrom(scope, name);
      if (found.kind == Variable::Kind::parameter)
        variables_.push_back(model_.parameters[found.index].desc);
      else if (found.kind == Variable::Kind::let)
        variables_.push_back(model_.lets[found.index].desc);
      else
        below_.insert(name.substr(name.rfind('.') + 1));
    }
  }

  void add(Scope& scope, const RefDesc& ref) {
    const std::uint32_t found = ref.import ? kNone : findEntity(model_, scope, ref.name, false);
    if (found == kNone) return;
    const Entity& entity = model_.entities[found];
    if (!entity.desc || (entity.shape.mips < 2 && entity.arrayCount < 2 && entity.shape.layers < 2)) return;
    Parts& parts = parts_[entity.desc];
    parts.level.add(onlyOf(ref.mip));
    parts.layer.add(onlyOf(ref.layer));
    parts.element.add(ref.element ? onlyOf(*ref.element) : std::string());
  }

  Model& model_;
  std::vector<const void*> variables_;  // declarations of parameters and lets, sorted
  std::set<std::string> below_;         // last parts of names that are looked for in included files
  std::unordered_map<const ResourceDesc*, Parts> parts_;
};

// What the author of a parameter that nothing reads has probably meant.
std::string hintFor(const Model& model, const Scope& scope, const ParameterDesc& unread) {
  const std::string& name = unread.name;
  for (const PassDesc& pass : scope.desc->passes)
    for (const PassParameterDesc& parameter : pass.parameters) {
      if (parameter.name != name) continue;
      return parameter.declared
                 ? fmt::format(
                       "pass '{}' declares a '{}' of its own: write \"{}\": \"${}\" there, or take "
                       "one of the two out",
                       pass.name, name, name, name)
                 : fmt::format("pass '{}' sets its '{}' to {}: write \"{}\": \"${}\" there", pass.name, name,
                               parameter.value.text(), name, name);
    }
  const auto same = model.parametersByLeaf.find(name);
  for (std::uint32_t index = same->second.first; index != kNone; index = model.parameters[index].nextOfLeaf)
    if (const std::string& path = model.parameters[index].path;
        model.parameters[index].desc != &unread && path.starts_with(scope.prefix))
      return fmt::format(
          "there is another, '{}': give it this value by \"set\": {{ \"{}\": … }}, and take "
          "this one out",
          path.substr(scope.prefix.size()), path.substr(scope.prefix.size()));
  return fmt::format(
      "write '${}' where its value is meant, such as \"parameters\": {{ \"{}\": \"${}\" }} of "
      "a pass, or take it out",
      name, name, name);
}

void warnVariables(Model& model, Scope& scope, const Uses& uses) {
  // What a stanza that is switched off for now reads is not unread.
  for (const PassDesc& pass : scope.desc->passes)
    if (pass.enabled.present() && pass.enabled.isConstant() && pass.enabled.text() == "false") return;
  for (const ParameterDesc& parameter : scope.desc->parameters) {
    if (uses.reads(parameter) || !isOnTop(scope, parameter.place)) continue;
    auto& d =
        model.diagnostics.warning(Code::unusedDeclaration, parameter.place,
                                  fmt::format("the parameter '{}' changes nothing: no expression reads '${}'",
                                              parameter.name, parameter.name));
    d.hint = hintFor(model, scope, parameter);
  }
  if (scope.parent) return;  // an including file may want it
  for (const NamedExpr& let : scope.desc->lets) {
    if (uses.reads(let) || !isOnTop(scope, let.place)) continue;
    auto& d = model.diagnostics.warning(
        Code::unusedDeclaration, let.place,
        fmt::format("the \"let\" '{}' changes nothing: no expression reads '${}'", let.name, let.name));
    d.hint = fmt::format("write '${}' where its value is meant, or take it out", let.name);
  }
}

void warnParts(Model& model, const Entity& entity, const Parts& parts) {
  const ResourceDesc& desc = *entity.desc;
  const auto warn = [&](const Selected& selected, std::uint32_t count, const Expr& said, const char* key,
                        const char* one, const char* many, const char* selector) {
    if (selected.several || count < 2) return;
    auto& d =
        model.diagnostics.warning(Code::unusedDeclaration, said.present() ? said.place() : desc.place,
                                  fmt::format("'{}' has {} {}, and all that is written and read is {} {}",
                                              entity.name, count, many, one, selected.one));
    d.resource = entity.name;
    d.hint = fmt::format("leave \"{}\" out, or use the others, such as '{}{}' in a pass with \"repeat\"", key,
                         desc.name, selector);
  };
  warn(parts.level, entity.shape.mips, desc.mips, "mips", "level", "levels", ".mip[i]");
  warn(parts.element, entity.arrayCount, desc.array, "array", "element", "elements", "[i]");
  if (desc.layers.present())
    warn(parts.layer, entity.shape.layers, desc.layers, "layers", "layer", "layers", ".layer[i]");
}

}  // namespace

bool isOnTop(const Scope& scope, const Place& place) {
  for (const Scope* outer = scope.parent; outer; outer = outer->parent)
    if (!outer->desc->top.empty()) return false;
  return scope.desc->top.empty() || (place.file && *place.file == scope.desc->top);
}

void warnUnused(Model& model) {
  const Uses uses(model);
  std::set<const GraphDesc*> said;  // a file that is included twice says it once
  for (Scope& scope : model.scopes)
    if (said.insert(scope.desc).second) warnVariables(model, scope, uses);
  std::set<const ResourceDesc*> judged;
  for (const Entity& entity : model.entities) {
    const bool own = entity.kind == ResourceDesc::Kind::texture || entity.kind == ResourceDesc::Kind::buffer;
    if (!own || !entity.desc || entity.state != Progress::done || !isOnTop(*entity.scope, entity.desc->place))
      continue;
    const Parts* parts = uses.partsOf(*entity.desc);
    if (parts && judged.insert(entity.desc).second) warnParts(model, entity, *parts);
  }
}

}  // namespace weft::graph::expansion
