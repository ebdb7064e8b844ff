#include "engine/graph/expand/names/scope.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "engine/graph/desc_walk.h"
#include "engine/graph/expand/names/names.h"
#include "engine/graph/expand/names/resources.h"
#include "engine/graph/language/expr_node.h"
#include "engine/graph/language/suffix.h"
#include "engine/text/limits.h"
#include "engine/text/nearest.h"

namespace weft::graph::expansion {

// ---- the scopes of a graph and its includes, before any name is looked up ----

namespace {

// `path` begins with the prefix of the scope; the rest is its name there.
void addParameter(Model& model, Scope& scope, const ParameterDesc& desc, std::string path) {
  const auto index = static_cast<std::uint32_t>(model.parameters.size());
  model.parametersByLeaf[desc.name].push_back(index);
  model.parameters.push_back({&desc, std::move(path), desc.initial, false, desc.initialPlace});
  const std::string_view name = std::string_view(model.parameters.back().path).substr(scope.prefix.size());
  scope.variables.try_emplace(name, Variable{Variable::Kind::parameter, index});
}

// How many of each there will be, of a file and all that it includes.
struct Counts {
  std::size_t scopes = 0, parameters = 0, lets = 0, resources = 0, sets = 0;
  void add(const GraphDesc& desc) {
    ++scopes;
    parameters += desc.parameters.size();
    lets += desc.lets.size();
    resources += desc.resources.size();
    sets += desc.sets.size();
    for (const PassDesc& pass : desc.passes) {
      for (const PassParameterDesc& parameter : pass.parameters) parameters += parameter.declared ? 1 : 0;
      if (pass.include && pass.include->graph) add(*pass.include->graph);
    }
  }
};

void buildScope(Model& model, Scope& scope);

// An input takes the whole of a resource.
void checkBind(Model& model, const IncludeDesc& include, const std::string& name, const RefDesc& ref) {
  std::vector<std::string> inputs;
  for (const ResourceDesc& resource : include.graph->resources)
    if (resource.kind == ResourceDesc::Kind::input) inputs.push_back(resource.name);
  if (std::ranges::find(inputs, name) == inputs.end())
    report(model, Code::badBind, ref.place,
           fmt::format("include '{}' binds '{}', which is no input of '{}'", include.as, name, include.file),
           {.hint = text::nearestHint(name, inputs)});
  const bool part = ref.mip || ref.layer || ref.face || ref.element || ref.stencil || ref.history ||
                    ref.condition.present() || ref.optional;
  if (!part && ref.wordsSize == 0) return;
  report(model, Code::badBind, ref.place,
         fmt::format("include '{}' binds '{}' to more than a name", include.as, name),
         {.expected = "the name of a whole resource",
          .found = ref.text,
          .hint = part ? fmt::format("bind a list, \"resources\": {{ \"{}\": [\"{}\"] }}", name, ref.text)
                       : fmt::format("write \"{}\" here, and '{}' in the slots that read it", ref.name,
                                     ref.words())});
}

void addInclude(Model& model, Scope& scope, const PassDesc& stanza) {
  const IncludeDesc& include = *stanza.include;
  if (!include.graph) {  // the reader said why
    for (Scope* outer = &scope; outer; outer = outer->parent) outer->broken = true;
    return;
  }
  Scope& child = model.scopes.emplace_back();
  child.desc = include.graph.get();
  child.parent = &scope;
  child.stanza = &stanza;
  child.prefix = scope.prefix + include.as + ".";
  scope.includes.try_emplace(include.as, &child);
  buildScope(model, child);
  for (const auto& [name, ref] : include.binds) checkBind(model, include, name, ref);
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
  const auto needed = [](const ResourceDesc& each) {
    return each.kind == ResourceDesc::Kind::input && !each.optional;
  };
  const auto first = std::ranges::find_if(model.desc.resources, needed);
  if (first == model.desc.resources.end()) return;
  model.toInclude = model.incomplete = true;
  const std::string file = std::filesystem::path(model.desc.path).filename().string();
  report(model, Code::unboundInput, first->place,
         fmt::format("'{}' is a file to include: nothing is behind its input '{}'", file, first->name),
         {.hint = fmt::format("include it: {{ \"include\": \"{}\", \"bind\": {{ \"{}\": … }} }}", file,
                              first->name),
          .resource = first->name});
}

// Follows a list to what it names, and returns how many alternatives it leads to, those of lists in it counted; 0 of what is no
// list. Reports lists that lead back to themselves or to too many: everything that follows lists later may visit each of
// these for each slot.
std::uint64_t weighList(Model& model, std::uint32_t index, std::vector<std::uint64_t>& weights) {
  Entity& entity = model.entities[index];
  if (entity.kind != ResourceDesc::Kind::alternatives || model.stopped) return 0;
  if (entity.listState == Progress::done || entity.listState == Progress::failed) return weights[index];
  const Evaluation evaluation(model, entity.listState, "'" + entity.name + "'", entity.desc->place,
                              "the alternatives of ", " lead back to it", ~std::size_t{0});
  if (!evaluation.good()) {
    model.incomplete = true;
    return 0;
  }
  const std::uint64_t most = text::raised(kMaxAlternatives);
  std::uint64_t weight = model.evaluating.size() > most ? most + 1 : 0;  // of itself, in too long a row
  for (std::size_t i = 0; i < entity.candidates.size() && weight <= most; ++i)
    if (entity.candidates[i] != kNone) weight += 1 + weighList(model, entity.candidates[i], weights);
  weights[index] = weight;
  if (weight > most)
    stopAt(model, entity.desc->place, fmt::format("'{}' has too many alternatives", entity.name),
           kMaxAlternatives, "alternatives of one list, those of lists in it counted");
  if (entity.listState == Progress::failed)
    entity.candidates.assign(entity.candidates.size(), kNone);
  else
    entity.listState = Progress::done;
  return weight;
}

void linkAlternatives(Model& model) {
  for (Entity& entity : model.entities) {
    if (entity.kind != ResourceDesc::Kind::alternatives) continue;
    for (const RefDesc& ref : entity.desc->alternatives) {
      if (isOver(model)) return;
      markStructural(model, *entity.scope, ref);
      entity.candidates.push_back(findEntityOrReport(model, *entity.scope, ref, {"a list of alternatives"}));
    }
  }
  std::vector<std::uint64_t> weights(model.entities.size(), 0);
  for (std::uint32_t i = 0; i < weights.size(); ++i) weighList(model, i, weights);
}

// Calls see(variable) for each $variable of the expression until it returns true; whether it did.
template <class See>
bool anyVariable(Model& model, Scope& scope, const Expr& expr, See&& see) {
  if (!expr.present() || expr.isConstant()) return false;
  return std::ranges::any_of(variablesOf(expr),
                             [&](const std::string& name) { return see(findVariable(model, scope, name)); });
}

// Sets `flag` of the lets for which `holds`, and of all that use them, perhaps through others. Without recursion, because lets
// may be many in a row.
template <class Holds>
void spread(Model& model, bool Let::*flag, Holds&& holds) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < model.lets.size(); ++i)
    if (holds(model.lets[i])) found.push_back(i);
  if (found.empty()) return;
  std::vector<std::vector<std::uint32_t>> users(model.lets.size());
  for (std::uint32_t i = 0; i < model.lets.size(); ++i)
    anyVariable(model, *model.lets[i].scope, model.lets[i].desc->expr, [&](const Variable& used) {
      if (used.kind == Variable::Kind::let) users[used.index].push_back(i);
      return false;
    });
  while (!found.empty()) {
    const std::uint32_t let = found.back();
    found.pop_back();
    if (std::exchange(model.lets[let].*flag, true)) continue;
    found.insert(found.end(), users[let].begin(), users[let].end());
  }
}

}  // namespace

void buildScopes(Model& model) {
  Counts counts;
  counts.add(model.desc);
  const std::tuple<std::size_t, std::uint64_t, const char*> bounds[] = {
      {counts.parameters, kMaxNames, "parameters"},
      {counts.lets, kMaxLets, "lets"},
      {counts.resources, kMaxNames, "resources"},
      {counts.sets, kMaxNames, "values in \"set\""}};
  for (const auto& [count, bound, what] : bounds)
    if (count > text::raised(bound))
      return stopAt(model, model.desc.place, fmt::format("the graph has too many {}", what), bound, what);
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
  spread(model, &Let::dynamic, [](const Let& let) { return let.desc->expr.dynamic(); });
  linkAlternatives(model);
}

// ---- resources ----

namespace {

// An optional input that nobody binds, where the including file has nothing of its name.
bool isLeftOut(Model& model, const Entity& entity, const RefDesc* bind) {
  const Scope* const parent = entity.scope->parent;
  return entity.desc->optional &&
         (!parent || (!bind && !parent->resources.contains(entity.desc->name) &&
                      findEntity(model, *entity.scope->parent, entity.desc->name, false) == kNone));
}

// Whether it may be bound to an input for a buffer or for a texture. An unknown import is reported where it stands.
bool fitsInput(const Model& model, const Entity& bound, bool wantsBuffer) {
  if (bound.kind == ResourceDesc::Kind::texture || bound.kind == ResourceDesc::Kind::buffer)
    return wantsBuffer == (bound.kind == ResourceDesc::Kind::buffer);
  if (bound.kind != ResourceDesc::Kind::import) return true;
  const ImportType* type =
      findImportType(model.registry, bound.desc ? bound.desc->import.type : bound.name.substr(1));
  return !type || (type->kind == ImportKind::texture) != wantsBuffer;
}

// What the includer binds to an input, or what it has of its name. kNone after a report.
std::uint32_t boundTo(Model& model, const Entity& input, const RefDesc* bind) {
  Scope& parent = *input.scope->parent;
  const std::string& name = input.desc->name;
  const PassDesc& stanza = *input.scope->stanza;
  const std::uint32_t target =
      bind ? findEntityOrReport(model, parent, *bind, {"\"bind\""}) : findEntity(model, parent, name, false);
  if (target == kNone) {
    // One of the includer's own that has nothing behind it was reported there.
    if (!bind && !parent.resources.contains(name))
      report(model, Code::unboundInput, stanza.place,
             fmt::format("include '{}' leaves the input '{}' without a resource", stanza.include->as, name),
             {.expected =
                  fmt::format("a resource '{0}' in the including file, or \"bind\": {{ \"{0}\": … }}", name),
              .hint = suffixHint(name, resourceNames(model, parent)),
              .resource = input.name});
    return kNone;
  }
  if (fitsInput(model, model.entities[target], input.desc->input == "buffer")) return target;
  report(model, Code::badBind, stanza.place,
         fmt::format("input '{}' is a {}, '{}' is not", input.name, input.desc->input,
                     model.entities[target].name),
         {.resource = model.entities[target].name});
  return kNone;
}

// Follows inputs to what is bound. kNone after a report.
std::uint32_t followInput(Model& model, std::uint32_t index) {
  Entity& entity = model.entities[index];
  if (entity.kind != ResourceDesc::Kind::input) return index;
  if (entity.bindState == Progress::done || entity.bindState == Progress::failed) return entity.bound;
  const Evaluation evaluation(model, entity.bindState, "'" + entity.name + "'", entity.desc->place, "input ",
                              " stands for itself");
  if (!evaluation.good()) return kNone;
  const RefDesc* bind = nullptr;
  if (entity.scope->parent)
    for (const auto& [input, ref] : entity.scope->stanza->include->binds)
      if (input == entity.desc->name) bind = &ref;
  if (isLeftOut(model, entity, bind)) {
    entity.kind = ResourceDesc::Kind::alternatives;  // a list of none
    entity.listState = Progress::done;
    entity.bound = index;
  } else if (entity.scope->parent) {  // else reportToInclude() said so
    entity.bound = boundTo(model, entity, bind);
  }
  entity.bindState = entity.bound == kNone ? Progress::failed : Progress::done;
  return entity.bound;
}

// An import declared under `name` here or in an enclosing file.
std::uint32_t declaredImport(Model& model, Scope& from, std::string_view name) {
  for (Scope* scope = &from; scope; scope = scope->parent)
    if (const auto found = scope->resources.find(name); found != scope->resources.end())
      if (model.entities[found->second].kind == ResourceDesc::Kind::import) return found->second;
  return kNone;
}

// The import type's entity with default arguments; kNone when there is no such type.
std::uint32_t implicitImport(Model& model, std::string_view type) {
  if (const auto found = model.implicitImports.find(type); found != model.implicitImports.end())
    return found->second;
  if (!findImportType(model.registry, type)) return kNone;
  const auto index = static_cast<std::uint32_t>(model.entities.size());
  Entity& entity = model.entities.emplace_back();
  entity.kind = ResourceDesc::Kind::import;
  entity.scope = &model.scopes[0];
  entity.name = "@" + std::string(type);
  model.implicitImports.emplace(std::string(type), index);
  return index;
}

}  // namespace

std::uint32_t findEntity(Model& model, Scope& scope, std::string_view name, bool import) {
  if (!import && name.starts_with('@')) return findEntity(model, scope, name.substr(1), true);
  if (!import)
    if (const auto found = scope.resources.find(name); found != scope.resources.end())
      return followInput(model, found->second);
  const std::size_t dot = name.find('.');
  if (import && dot == std::string_view::npos) {
    const std::uint32_t declared = declaredImport(model, scope, name);
    return declared != kNone ? declared : implicitImport(model, name);
  }
  if (import) {
    const std::uint32_t dotted = findEntity(model, scope, name, false);
    return dotted != kNone && model.entities[dotted].kind == ResourceDesc::Kind::import ? dotted : kNone;
  }
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

namespace {

// "noise.png": a file in the place of a resource. "lit.hdr" is a resource.
bool isPicturePath(std::string_view name) {
  return name.ends_with(".png") || name.ends_with(".jpg") || name.ends_with(".jpeg") ||
         name.ends_with(".exr");
}

std::string_view firstPart(std::string_view name) {
  return name.substr(0, name.find('.'));
}

// The fix for a resource that is not there.
std::string hintForResource(const Model& model, const Scope& scope, std::string_view name,
                            const NamedBy& by) {
  if (isPicturePath(name))
    return fmt::format(
        "a picture is a resource: declare {{ \"{0}\": {{ \"import\": \"image\", \"file\": \"{1}\" }} }} and "
        "name \"{0}\" here",
        firstPart(name.substr(name.rfind('/') + 1)), name);
  // A whole name in its own file.
  if (!scope.prefix.empty() && name.starts_with(scope.prefix)) name.remove_prefix(scope.prefix.size());
  if (findImportType(model.registry, name)) return fmt::format("did you mean the import '@{}'?", name);
  for (const Scope* outer = scope.resources.contains(name) ? nullptr : scope.parent; outer;
       outer = outer->parent)
    if (outer->resources.contains(name) || outer->includes.contains(firstPart(name)))
      return fmt::format(
          "the including file has it: declare \"{}\": {{ \"input\": \"texture\" }} in the file of the pass",
          name.substr(name.rfind('.') + 1));
  if (const PassDesc* pass = by.orPass ? nullptr : findPass(scope, name))
    for (const SlotDesc& slot : pass->slots)
      if (slot.access != Access::read)
        return fmt::format("'{}' is a pass: name what it writes, '{}'", name, slot.ref.name);
  std::vector<std::string> names = resourceNames(model, scope);
  for (const auto& [pass, stanza] : scope.passes)
    if (by.orPass) names.emplace_back(pass);
  return suffixHint(name, names);
}

}  // namespace

std::uint32_t findEntityOrReport(Model& model, Scope& scope, const RefDesc& ref, const NamedBy& by) {
  const std::string& name = ref.name;
  const bool import = ref.import;
  const std::size_t before = model.diagnostics.errorCount();
  const std::uint32_t found = findEntity(model, scope, name, import);
  if (found != kNone || isOver(model) || model.diagnostics.errorCount() > before) return found;
  // Its declaration was reported, or it is an input with nothing behind it, which was.
  if (isUnread(scope, name) || (!import && scope.resources.contains(name))) return kNone;
  if (!import && isUnincluded(model, scope, name, ref.place, by)) return kNone;
  const std::string written = (import ? "@" : "") + name;
  report(model, import ? Code::unknownImport : Code::unknownResource, ref.place,
         fmt::format("{} {} the unknown {} '{}'", by.user, by.verb, import ? "import" : "resource", written),
         {.hint = !import ? hintForResource(model, scope, name, by)
                  : scope.resources.contains(name)
                      ? fmt::format("'{}' is a resource of this graph: write it without the @", name)
                      : hintForImport(model.registry, name),
          .resource = written,
          .pass = std::string(by.pass)});
  return kNone;
}

const PassDesc* findPass(const Scope& scope, std::string_view name) {
  const auto found = scope.passes.find(name);
  return found == scope.passes.end() ? nullptr : found->second;
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

// ---- names that are unknown ----

const PassDesc* failedInclude(const Scope& scope) {
  for (const PassDesc& pass : scope.desc->passes)
    if (pass.include && !pass.include->graph) return &pass;
  return nullptr;
}

bool isUnread(const Scope& from, std::string_view name) {
  const std::string_view leaf = name.substr(name.rfind('.') + 1);
  const auto holds = [&](const Scope& scope) {
    const auto& unread = scope.desc->unread;
    return std::ranges::find(unread, leaf) != unread.end();
  };
  for (const Scope* scope = &from; scope; scope = scope->parent)
    if (holds(*scope)) return true;
  if (name.find('.') == std::string_view::npos) return false;
  // A name into an include that could not be read, or that left the resource out.
  const auto child = from.includes.find(name.substr(0, name.find('.')));
  if (child != from.includes.end()) return isUnread(*child->second, name.substr(name.find('.') + 1));
  const std::string_view first = firstPart(name);
  for (const PassDesc& pass : from.desc->passes)  // the path may be what is misspelt, and so the name
    if (pass.include && !pass.include->graph && (pass.include->as == first || from.resources.contains(first)))
      return true;
  return false;
}

bool mayBeUnread(const Scope& from, std::string_view name) {
  return from.broken || isUnread(from, name);
}

bool isUnincluded(Model& model, Scope& scope, std::string_view name, const Place& place, const NamedBy& by) {
  const std::string_view first = firstPart(name);
  if (first.size() == name.size() || isPicturePath(name) || scope.includes.contains(first) ||
      scope.resources.contains(first) || scope.passes.contains(first))
    return false;
  model.incomplete = true;
  if (!model.unknown.emplace(&scope, first).second || failedInclude(scope)) return true;
  std::string hint = hintForResource(model, scope, name, by);
  if (hint.empty())
    hint = fmt::format("include a file as that, {{ \"include\": \"{0}.json\", \"as\": \"{0}\" }}", first);
  report(model, Code::unknownResource, place,
         fmt::format("{} {} the unknown resource '{}': nothing is included as '{}'", by.user, by.verb, name,
                     first),
         {.hint = std::move(hint), .resource = std::string(name), .pass = std::string(by.pass)});
  return true;
}

// ---- variables ----

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

std::vector<std::uint32_t> parametersMeant(const Model& model, std::string_view prefix,
                                           std::string_view name) {
  std::vector<std::uint32_t> meant;
  const auto leaves = model.parametersByLeaf.find(name.substr(name.rfind('.') + 1));
  if (leaves == model.parametersByLeaf.end()) return meant;
  for (const std::uint32_t index : leaves->second) {
    const std::string_view path = model.parameters[index].path;
    if (!path.starts_with(prefix)) continue;
    if (path.substr(prefix.size()) == name) return {index};
    if (hasSuffix(path.substr(prefix.size()), name)) meant.push_back(index);
  }
  return meant;
}

Variable findVariable(Model& model, Scope& from, std::string_view name) {
  if (const Variable found = findVariableFrom(from, name); found.kind != Variable::Kind::none) return found;
  if (const auto known = from.below.find(name); known != from.below.end()) return known->second;
  const std::vector<std::uint32_t> meant = parametersMeant(model, from.prefix, name);
  Variable found;
  if (!meant.empty())
    found = {meant.size() == 1 ? Variable::Kind::parameter : Variable::Kind::ambiguous, meant[0]};
  from.below.emplace(name, found);
  return found;
}

std::uint32_t findPassParameter(const Scope& scope, const std::string& pass, const std::string& name) {
  const auto found = scope.variables.find(pass + "." + name);
  const bool known = found != scope.variables.end() && found->second.kind == Variable::Kind::parameter;
  return known ? found->second.index : kNone;
}

// ---- what expressions depend on ----

bool checkExpr(Model& model, Scope& scope, const Expr& expr, bool dynamicAllowed,
               std::span<const RangeDesc> repeat) {
  if (!expr.present() || expr.isConstant()) return true;
  const std::size_t before = model.diagnostics.errorCount();
  Names names(model, scope, dynamicAllowed);
  for (const RangeDesc& range : repeat) names.indices.push_back({range.index, 0});
  expr.check(names, model.diagnostics);
  for (const auto& [fact, name] : expr.facts()) {
    if (findEntity(model, scope, name, false) != kNone || findEntity(model, scope, name, true) != kNone)
      continue;
    if (fact == Fact::has && findAskedPass(scope, name).desc) continue;
    const std::size_t known = model.diagnostics.errorCount();
    NamedBy by = kAsksOf;
    by.orPass = fact == Fact::has;
    const bool import = name.starts_with("@");
    RefDesc asked{.place = expr.place(), .name = name.substr(import ? 1 : 0), .import = import};
    findEntityOrReport(model, scope, asked, by);
    if (model.diagnostics.errorCount() > known) model.unknown.emplace(&scope, name);
  }
  return model.diagnostics.errorCount() == before;
}

bool isDynamic(Model& model, Scope& scope, const Expr& expr) {
  return expr.present() && (expr.dynamic() || anyVariable(model, scope, expr, [&](const Variable& used) {
                              return used.kind == Variable::Kind::let && model.lets[used.index].dynamic;
                            }));
}

bool isLive(Model& model, Scope& scope, const Expr& expr) {
  return anyVariable(model, scope, expr, [&](const Variable& used) {
    return used.kind == Variable::Kind::let         ? model.lets[used.index].live
           : used.kind == Variable::Kind::parameter ? !model.parameters[used.index].structural
                                                    : false;
  });
}

void findLiveLets(Model& model) {
  spread(model, &Let::live, [&](const Let& let) { return isLive(model, *let.scope, let.desc->expr); });
}

void markStructural(Model& model, Scope& scope, const Expr& expr) {
  std::vector<Let*> lets;  // still to be followed
  const auto mark = [&](const Variable& used) {
    if (used.kind == Variable::Kind::parameter) model.parameters[used.index].structural = true;
    if (used.kind == Variable::Kind::let && !std::exchange(model.lets[used.index].structural, true))
      lets.push_back(&model.lets[used.index]);
    return false;
  };
  anyVariable(model, scope, expr, mark);
  while (!lets.empty()) {
    Let& let = *lets.back();
    lets.pop_back();
    anyVariable(model, *let.scope, let.desc->expr, mark);
  }
}

void markStructural(Model& model, Scope& scope, const RefDesc& ref) {
  visitRef(
      ref, [&](const Expr& expr) { markStructural(model, scope, expr); }, [](const RefDesc&) {});
}

bool countsElements(Model& model, Scope& scope, const Expr& expr) {
  std::vector<std::pair<Scope*, const Expr*>> open{{&scope, &expr}};
  std::set<std::uint32_t> seen;  // lets
  while (!open.empty()) {
    const auto [from, each] = open.back();
    open.pop_back();
    if (!each->present()) continue;
    for (const auto& [fact, name] : each->facts())
      if (fact == Fact::count || fact == Fact::has) return true;
    anyVariable(model, *from, *each, [&](const Variable& used) {
      if (used.kind == Variable::Kind::let && seen.insert(used.index).second)
        open.emplace_back(model.lets[used.index].scope, &model.lets[used.index].desc->expr);
      return false;
    });
  }
  return false;
}

}  // namespace weft::graph::expansion
