#include "engine/graph/expand/names/scope.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <functional>
#include <set>
#include <utility>

#include "engine/base/limits.h"
#include "engine/base/nearest.h"
#include "engine/graph/expand/names/names.h"
#include "engine/graph/expand/names/resources.h"
#include "engine/graph/expand/names/unread.h"
#include "engine/graph/language/expr_node.h"
#include "engine/graph/language/suffix.h"

namespace weft::graph::expansion {

// ---- the scopes of a graph and its includes, before any name is looked up ----

namespace {

// `path` begins with the prefix of the scope; the rest is its name there.
void addParameter(Model& model, Scope& scope, const ParameterDesc& desc, std::string path) {
  const auto index = static_cast<std::uint32_t>(model.parameters.size());
  Leaves& leaves = model.parametersByLeaf[desc.name];
  (leaves.count++ == 0 ? leaves.first : model.parameters[leaves.last].nextOfLeaf) = index;
  leaves.last = index;
  assert(index < model.parameters.capacity());
  model.parameters.push_back({&desc, std::move(path), desc.initial, false, desc.initialPlace});
  const std::string_view name = std::string_view(model.parameters.back().path).substr(scope.prefix.size());
  scope.variables.try_emplace(name, Variable{Variable::Kind::parameter, index});
}

// How many of each there will be, of a file and all that it includes, and the first that is one too many.
struct Counts {
  std::size_t scopes = 0, parameters = 0, lets = 0, resources = 0, sets = 0;
  const Place* excess = nullptr;
  const char* what = "";
  std::uint64_t most = 0;

  void add(std::size_t& count, std::uint64_t bound, const char* name, const Place& place) {
    if (++count <= base::raised(bound) || excess) return;
    excess = &place;
    what = name;
    most = bound;
  }
  void add(const GraphDesc& desc) {
    ++scopes;
    const auto addParameter = [&](const ParameterDesc& each) {
      add(parameters, kMostNames, "parameters", each.place);
    };
    for (const ParameterDesc& parameter : desc.parameters) addParameter(parameter);
    for (const NamedExpr& let : desc.lets) add(lets, kMostLets, "lets", let.place);
    for (const ResourceDesc& resource : desc.resources)
      add(resources, kMostNames, "resources", resource.place);
    for (const SetDesc& set : desc.sets) add(sets, kMostNames, "values in \"set\"", set.place);
    for (const PassDesc& pass : desc.passes) {
      for (const PassParameterDesc& parameter : pass.parameters)
        if (parameter.declared) addParameter(*parameter.declared);
      if (pass.include && pass.include->graph) add(*pass.include->graph);
    }
  }
};

void buildScope(Model& model, Scope& scope);

void addInclude(Model& model, Scope& scope, const PassDesc& stanza) {
  const IncludeDesc& include = *stanza.include;
  if (!include.graph) {  // the reader said why
    for (Scope* outer = &scope; outer; outer = outer->parent) outer->broken = true;
    return;
  }
  assert(model.scopes.size() < model.scopes.capacity());
  Scope& child = model.scopes.emplace_back();
  child.desc = include.graph.get();
  child.parent = &scope;
  child.stanza = &stanza;
  child.prefix = scope.prefix + include.as + ".";
  child.group = include.group.empty() ? scope.group : scope.prefix + include.group;
  scope.includes.try_emplace(include.as, &child);
  buildScope(model, child);
  std::vector<std::string> inputs;
  for (const ResourceDesc& resource : child.desc->resources)
    if (resource.kind == ResourceDesc::Kind::input) inputs.push_back(resource.name);
  for (const auto& [name, ref] : include.binds) {
    const bool part = ref.mip || ref.layer || ref.face || ref.element || ref.stencil || ref.history ||
                      ref.condition.present() || ref.optional;
    if (std::find(inputs.begin(), inputs.end(), name) == inputs.end()) {
      auto& d = model.diagnostics.error(
          Code::badBind, ref.place,
          fmt::format("include '{}' binds '{}', which is no input of '{}'", include.as, name, include.file));
      d.hint = base::nearestHint(name, inputs);
    }
    if (part) {
      auto& d = model.diagnostics.error(
          Code::badBind, ref.place,
          fmt::format("include '{}' binds '{}' to a part of a resource", include.as, name));
      d.expected = "the name of a whole resource";
      d.found = ref.text;
      d.hint =
          fmt::format("give the part a name with a resource that is a list, \"{}\": [\"{}\"], and bind that",
                      name, ref.text);
    } else if (const std::string_view words = ref.words(); !words.empty()) {
      auto& d = model.diagnostics.error(
          Code::badBind, ref.place,
          fmt::format("include '{}' binds '{}' {}, which only a slot can say", include.as, name, words));
      d.expected = "the name of a whole resource";
      d.found = ref.text;
      d.hint = fmt::format("write \"{}\" here, and '{} {}' in the slots of '{}' that read it", ref.name, name,
                           words, include.file);
    }
  }
}

void buildScope(Model& model, Scope& scope) {
  const GraphDesc& desc = *scope.desc;
  scope.variables.reserve(desc.parameters.size() + desc.lets.size());
  scope.resources.reserve(desc.resources.size());
  scope.passes.reserve(desc.passes.size());
  for (const ParameterDesc& parameter : desc.parameters)
    addParameter(model, scope, parameter, scope.prefix + parameter.name);
  for (const NamedExpr& let : desc.lets) {
    scope.variables.try_emplace(let.name,
                                Variable{Variable::Kind::let, static_cast<std::uint32_t>(model.lets.size())});
    Let& made = model.lets.emplace_back();
    made.desc = &let;
    made.scope = &scope;
    made.path = scope.prefix + let.name;
  }
  for (const ResourceDesc& resource : desc.resources) {
    if (!scope.resources.try_emplace(resource.name, static_cast<std::uint32_t>(model.entities.size())).second)
      continue;
    Entity& entity = model.entities.emplace_back();
    entity.kind = resource.kind;
    entity.desc = &resource;
    entity.scope = &scope;
    entity.name = scope.prefix + resource.name;
  }
  for (const PassDesc& pass : desc.passes) {
    if (pass.include) {
      addInclude(model, scope, pass);
      continue;
    }
    if (!scope.passes.try_emplace(pass.name, &pass).second) continue;  // W009 of the reader
    for (const PassParameterDesc& parameter : pass.parameters)
      if (parameter.declared)
        addParameter(model, scope, *parameter.declared, scope.prefix + pass.name + "." + parameter.name);
  }
}

// A file with inputs that is opened by itself has nothing behind them.
void reportToInclude(Model& model) {
  const GraphDesc& desc = model.desc;
  const ResourceDesc* first = nullptr;
  std::string inputs, binds;
  for (const ResourceDesc& resource : desc.resources) {
    if (resource.kind != ResourceDesc::Kind::input || resource.optional) continue;
    if (!first) first = &resource;
    inputs += (inputs.empty() ? "" : ", ") + resource.name;
    if (binds.empty()) binds = fmt::format("\"{}\": …", resource.name);
  }
  if (!first) return;
  model.toInclude = model.incomplete = true;
  const std::string file = std::filesystem::path(desc.path).filename().string();
  auto& d = model.diagnostics.error(
      Code::unboundInput, first->place,
      fmt::format("'{}' is a file to include, not a graph: nothing is behind its inputs ({})", file, inputs));
  d.resource = first->name;
  d.hint = fmt::format(
      "open a graph that includes it, or include it in one: {{ \"include\": \"{}\", \"bind\": {{ {} }} }}",
      file, binds);
}

}  // namespace

void buildScopes(Model& model) {
  Counts counts;
  counts.add(model.desc);
  if (counts.excess)
    return stopAt(model, *counts.excess, fmt::format("the graph has too many {}", counts.what), counts.most,
                  counts.what);
  model.scopes.reserve(counts.scopes);
  model.parameters.reserve(counts.parameters);
  model.parametersByLeaf.reserve(counts.parameters);
  model.lets.reserve(counts.lets);
  // Each type of import may be named without a declaration.
  model.entities.reserve(counts.resources + model.registry.imports.size());
  Scope& root = model.scopes.emplace_back();
  root.desc = &model.desc;
  buildScope(model, root);
  reportToInclude(model);
  findDynamicLets(model);
  linkAlternatives(model);
}

// ---- lists of alternatives ----

namespace {

// Follows a list to what it names, and returns how many alternatives it leads to, those of lists in it counted; 0 of what is no
// list. Reports lists that lead back to themselves or to too many: everything that follows lists later may visit each of
// these for each slot.
std::uint64_t weighList(Model& model, std::uint32_t index, std::vector<std::uint64_t>& weights) {
  Entity& entity = model.entities[index];
  if (entity.kind != ResourceDesc::Kind::alternatives || model.stopped) return 0;
  if (entity.listState == Progress::done || entity.listState == Progress::failed) return weights[index];
  std::string label = "'" + entity.name + "'";
  if (entity.listState == Progress::active) {
    reportCycle(model, entity.desc->place,
                fmt::format("the alternatives of {} lead back to it: {}", label, cyclePath(model, label)))
        .resource = entity.name;
    entity.listState = Progress::failed;
    model.incomplete = true;
    return 0;
  }
  entity.listState = Progress::active;
  model.evaluating.push_back(std::move(label));
  const std::uint64_t most = base::raised(kMostAlternatives);
  std::uint64_t weight = model.evaluating.size() > most ? most + 1 : 0;
  for (std::size_t i = 0; i < entity.candidates.size() && weight <= most; ++i)
    if (entity.candidates[i] != kNone) weight += 1 + weighList(model, entity.candidates[i], weights);
  model.evaluating.pop_back();
  weights[index] = weight;
  if (weight > most)
    stopAt(model, entity.desc->place, fmt::format("'{}' has too many alternatives", entity.name),
           kMostAlternatives, "alternatives of one list, those of lists in it counted");
  if (entity.listState == Progress::failed)
    entity.candidates.assign(entity.candidates.size(), kNone);
  else
    entity.listState = Progress::done;
  return weight;
}

}  // namespace

void linkAlternatives(Model& model) {
  for (Entity& entity : model.entities) {
    if (entity.kind != ResourceDesc::Kind::alternatives) continue;
    for (const RefDesc& ref : entity.desc->alternatives) {
      if (isOver(model)) return;
      markStructural(model, *entity.scope, ref);
      entity.candidates.push_back(findEntityOrReport(model, *entity.scope, ref.name, ref.import, ref.place,
                                                     {"a list of alternatives"}));
    }
  }
  std::vector<std::uint64_t> weights(model.entities.size(), 0);
  for (std::uint32_t i = 0; i < weights.size(); ++i) weighList(model, i, weights);
}

// ---- names ----

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
  const Descent descent(model, entity.desc->place, entity.name);
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
                                  {"\"bind\"", "names"});
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

std::vector<std::string> resourceNames(const Model& model, const Scope& scope) {
  std::vector<std::string> names;
  for (const Entity& entity : model.entities)
    if (entity.desc && entity.name.starts_with(scope.prefix))
      names.push_back(entity.name.substr(scope.prefix.size()));
  return names;
}

static std::string hintForView(std::string_view name) {
  return fmt::format("declare it: \"resources\": {{ \"{}\": {{ \"import\": \"camera\" }} }}", name);
}

std::uint32_t findEntityOrReport(Model& model, Scope& scope, std::string_view name, bool import,
                                 const Place& place, const NamedBy& by) {
  const std::size_t before = model.diagnostics.errorCount();
  const std::uint32_t found = findEntity(model, scope, name, import);
  if (found == kNone && isOver(model)) return kNone;
  if (found != kNone || model.diagnostics.errorCount() > before) return found;
  if (isUnread(scope, name)) return kNone;  // the reader reported its declaration
  if (!isPicturePath(name) && isUnincluded(model, scope, name, place, by)) return kNone;
  // An input with nothing behind it was reported where it stands.
  if (!import && scope.resources.contains(name)) return kNone;
  const bool view = by.slot == "view";
  auto& d = model.diagnostics.error(import ? Code::unknownImport : Code::unknownResource, place,
                                    fmt::format("{} {} the unknown {} '{}{}'", by.user, by.verb,
                                                import ? "import" : "resource", import ? "@" : "", name));
  d.resource = (import ? "@" : "") + std::string(name);
  d.pass = by.pass;
  if (!import) {
    d.hint = hintForResource(model, scope, name, by, place);
    if (view && !d.hint.starts_with("did you mean")) d.hint = "write '@camera', or " + hintForView(name);
    return kNone;
  }
  std::vector<std::string> types;
  for (const ImportType& type : model.registry.imports) types.push_back(type.name);
  d.hint = scope.resources.contains(name)
               ? fmt::format("'{}' is a resource of this graph: write it without the @", name)
               : hintForImport(name, types);
  if (view && d.hint.starts_with("imports are")) d.hint = hintForView(name);
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
  const auto [known, fresh] = from.below.try_emplace(name);
  if (!fresh) return known->second;
  Variable& result = known->second;
  for (std::uint32_t index = leaves->second.first; index != kNone;
       index = model.parameters[index].nextOfLeaf) {
    const std::string& path = model.parameters[index].path;
    if (!path.starts_with(from.prefix) || !hasSuffix(path, name)) continue;
    result = {result.kind == Kind::none ? Kind::parameter : Kind::ambiguous,
              result.kind == Kind::none ? index : result.index};
    if (result.kind == Kind::ambiguous) break;
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
    NamedBy by = kAsksOf;
    by.orPass = fact == Fact::has;
    findEntityOrReport(model, scope, name, name.starts_with("@"), expr.place(), by);
    if (model.diagnostics.errorCount() > known) model.unknownFacts.emplace(&scope, name);
  }
  return model.diagnostics.errorCount() == before;
}

// ---- what expressions depend on through lets; without recursion, because lets may stand in long rows ----

namespace {

// Sets `flag` of the lets in `found` and of all that use them, perhaps through others.
void spread(Model& model, std::vector<std::uint32_t> found, bool Let::*flag) {
  if (found.empty()) return;
  std::vector<std::vector<std::uint32_t>> users(model.lets.size());
  for (std::uint32_t i = 0; i < model.lets.size(); ++i)
    for (const std::string& name : variablesOf(model.lets[i].desc->expr))
      if (const Variable used = findVariable(model, *model.lets[i].scope, name);
          used.kind == Variable::Kind::let)
        users[used.index].push_back(i);
  while (!found.empty()) {
    const std::uint32_t let = found.back();
    found.pop_back();
    if (std::exchange(model.lets[let].*flag, true)) continue;
    found.insert(found.end(), users[let].begin(), users[let].end());
  }
}

bool readsLive(Model& model, Scope& scope, const Expr& expr) {
  if (!expr.present() || expr.isConstant()) return false;
  for (const std::string& name : variablesOf(expr))
    if (const Variable variable = findVariable(model, scope, name);
        variable.kind == Variable::Kind::parameter && !model.parameters[variable.index].structural)
      return true;
  return false;
}

}  // namespace

// Every let that contains age(), perhaps through another: from those that say it to those that use them.
void findDynamicLets(Model& model) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < model.lets.size(); ++i)
    if (model.lets[i].desc->expr.dynamic()) found.push_back(i);
  spread(model, std::move(found), &Let::dynamic);
}

void findLiveLets(Model& model) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < model.lets.size(); ++i)
    if (readsLive(model, *model.lets[i].scope, model.lets[i].desc->expr)) found.push_back(i);
  spread(model, std::move(found), &Let::live);
}

bool isLive(Model& model, Scope& scope, const Expr& expr) {
  if (readsLive(model, scope, expr)) return true;
  if (!expr.present() || expr.isConstant()) return false;
  for (const std::string& name : variablesOf(expr)) {
    const Variable variable = findVariable(model, scope, name);
    if (variable.kind == Variable::Kind::let && model.lets[variable.index].live) return true;
  }
  return false;
}

void markStructural(Model& model, Scope& scope, const Expr& expr) {
  std::vector<Let*> lets;  // still to be followed
  const auto mark = [&](Scope& from, const Expr& each) {
    if (!each.present() || each.isConstant()) return;
    for (const std::string& name : variablesOf(each)) {
      const Variable variable = findVariable(model, from, name);
      if (variable.kind == Variable::Kind::parameter) model.parameters[variable.index].structural = true;
      if (variable.kind == Variable::Kind::let && !std::exchange(model.lets[variable.index].structural, true))
        lets.push_back(&model.lets[variable.index]);
    }
  };
  mark(scope, expr);
  while (!lets.empty()) {
    Let& let = *lets.back();
    lets.pop_back();
    mark(*let.scope, let.desc->expr);
  }
}

void markStructural(Model& model, Scope& scope, const RefDesc& ref) {
  markStructural(model, scope, ref.condition);
  if (ref.element) markStructural(model, scope, *ref.element);
  for (const std::optional<SpanDesc>* span : {&ref.mip, &ref.layer, &ref.face})
    if (*span) {
      markStructural(model, scope, (*span)->first);
      markStructural(model, scope, (*span)->last);
    }
}

bool isDynamic(Model& model, Scope& scope, const Expr& expr) {
  if (!expr.present() || expr.isConstant()) return false;
  if (expr.dynamic()) return true;
  for (const std::string& name : variablesOf(expr)) {
    const Variable variable = findVariable(model, scope, name);
    if (variable.kind == Variable::Kind::let && model.lets[variable.index].dynamic) return true;
  }
  return false;
}

namespace {

// Calls `see` with the expression and those of all lets that it reads, and the scope of each, until that returns true.
bool anyThroughLets(Model& model, Scope& scope, const Expr& expr,
                    const std::function<bool(Scope&, const Expr&)>& see) {
  std::vector<std::pair<Scope*, const Expr*>> open{{&scope, &expr}};
  std::set<std::uint32_t> seen;  // lets
  while (!open.empty()) {
    const auto [from, each] = open.back();
    open.pop_back();
    if (!each->present() || each->isConstant()) continue;
    if (see(*from, *each)) return true;
    for (const std::string& name : variablesOf(*each))
      if (const Variable variable = findVariable(model, *from, name);
          variable.kind == Variable::Kind::let && seen.insert(variable.index).second)
        open.emplace_back(model.lets[variable.index].scope, &model.lets[variable.index].desc->expr);
  }
  return false;
}

// What differs with the settings, the size or the scene.
bool isVariable(Model& model, Scope& scope, const Expr& expr) {
  return anyThroughLets(model, scope, expr, [&](Scope& from, const Expr& each) {
    const std::vector<std::string> names = variablesOf(each);
    const auto isLet = [&](const std::string& name) {
      return findVariable(model, from, name).kind == Variable::Kind::let;
    };
    const std::string text = each.text();
    return !each.facts().empty() || names.empty() || !std::ranges::all_of(names, isLet) ||
           text.find("screen") != std::string::npos || text.find("device.") != std::string::npos;
  });
}

// Whether it may be small only for now: a list is empty, or the size took levels away.
bool mayBeShort(Model& model, Scope& scope, const Expr& expr) {
  return countsElements(model, scope, expr) ||
         anyThroughLets(model, scope, expr, [&](Scope& from, const Expr& each) {
           for (const auto& [fact, name] : each.facts()) {
             const std::uint32_t found = fact == Fact::mips ? findEntity(model, from, name, false) : kNone;
             if (found != kNone && model.entities[found].shape.mips < model.entities[found].writtenMips)
               return true;
           }
           return false;
         });
}

}  // namespace

bool countsElements(Model& model, Scope& scope, const Expr& expr) {
  return anyThroughLets(model, scope, expr, [](Scope&, const Expr& each) {
    return std::ranges::any_of(each.facts(), [](const auto& asked) {
      return asked.first == Fact::count || asked.first == Fact::has;
    });
  });
}

bool isEmptyByMistake(Model& model, Scope& scope, const PassDesc& desc, const RangeDesc& range,
                      std::int64_t first, std::int64_t last, std::int64_t step) {
  for (const RangeDesc& outer : desc.repeat)
    if (range.first.says(outer.index) || range.last.says(outer.index))
      return false;  // empty for some of them
  if (desc.enabled.present() && !isDynamic(model, scope, desc.enabled)) {
    Names names(model, scope);
    base::Diagnostics ignored;
    const Value enabled = desc.enabled.evaluate(names, ignored);
    if (enabled.type != Value::Type::none && !enabled.truth()) return false;
  }
  // The bound that makes the range longer as it grows, or as it falls.
  const Expr &far = step > 0 ? range.last : range.first, &near = step > 0 ? range.first : range.last;
  if (!isVariable(model, scope, far)) return true;
  return (last - first) / step < -1 && isVariable(model, scope, near) && !mayBeShort(model, scope, far);
}

}  // namespace weft::graph::expansion
