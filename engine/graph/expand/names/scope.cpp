// Declared in names.h.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <tuple>
#include <utility>

#include "engine/graph/expand/names/names.h"
#include "engine/graph/language/names.h"
#include "engine/text/limits.h"
#include "engine/text/nearest.h"
#include "graph_sentences.h"

namespace weft::graph::expansion {

// ---- the scopes of a graph and its includes, before any name is looked up ----

namespace {

// Makes a variable known in its file, and in those that include it by the names that it has there: `path` begins with the prefix of each.
void declare(Scope& scope, std::string_view path, const Variable& variable) {
  for (Scope* in = &scope; in; in = in->parent)
    in->variables.try_emplace(path.substr(in->prefix.size()), variable);
}

void addParameter(Model& model, Scope& scope, const ParameterDesc& desc, std::string path) {
  const auto index = static_cast<std::uint32_t>(model.parameters.size());
  model.parametersByLeaf[desc.name].push_back(index);
  // A variant is chosen before the first frame.
  model.parameters.push_back(
      {{std::move(path), desc.initial, Origin::declaration, desc.initialPlace, desc.define}, &desc, &scope});
  declare(scope, model.parameters.back().path, {Variable::Kind::parameter, index});
}

void buildScope(Model& model, Scope& scope);

bool isInput(const ResourceDesc& resource) {
  return resource.kind == ResourceDesc::Kind::input;
}

// Whether the file declares the resource itself.
bool hasOwn(const Model& model, const Scope& scope, const std::string& name) {
  const auto found = scope.resources.find(name);
  return found != scope.resources.end() && !isInput(*model.entities[found->second].desc);
}

// The type of the import that a file names or declares under a name. Null: there is none.
const ImportType* importTypeOf(const Model& model, const GraphDesc& file, std::string_view name) {
  const ResourceDesc* const own = findNamed(file.resources, name);
  if (own && own->kind != ResourceDesc::Kind::import) return nullptr;
  return findNamed(model.registry.imports, own ? std::string_view(own->import.type) : name);
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
}

void buildScope(Model& model, Scope& scope) {
  const GraphDesc& desc = *scope.desc;
  const auto isImport = [&](const auto& bind) { return importTypeOf(model, desc, bind.first) != nullptr; };
  if (scope.parent && std::ranges::any_of(scope.stanza->include->binds, isImport))
    for (const ImportType& type : model.registry.imports)
      if (std::ranges::any_of(type.arguments, &ImportArgument::view)) {
        scope.imports.emplace(type.name, static_cast<std::uint32_t>(model.entities.size()));
        model.entities.push_back(
            {.kind = ResourceDesc::Kind::import, .scope = &scope, .name = "@" + scope.prefix + type.name});
      }
  for (const ParameterDesc& parameter : desc.parameters)
    addParameter(model, scope, parameter, scope.prefix + parameter.name);
  for (const NamedExpr& let : desc.lets) {
    const auto index = static_cast<std::uint32_t>(model.lets.size());
    model.lets.push_back({.desc = &let, .scope = &scope, .path = scope.prefix + let.name});
    declare(scope, model.lets.back().path, {Variable::Kind::let, index});
  }
  for (const ResourceDesc& resource : desc.resources)
    if (scope.resources.try_emplace(resource.name, static_cast<std::uint32_t>(model.entities.size())).second)
      model.entities.push_back({.kind = resource.kind,
                                .desc = &resource,
                                .scope = &scope,
                                .name = scope.prefix + resource.name,
                                .sample = resource.sample ? &*resource.sample : nullptr});
  for (const PassDesc& pass : desc.passes) {
    if (pass.include) addInclude(model, scope, pass);
    if (model.stopped) return;
    if (pass.include || !scope.passes.try_emplace(pass.name, &pass).second) continue;  // W009 of the reader
    for (const PassParameterDesc& parameter : pass.parameters)
      if (parameter.declared) {
        addParameter(model, scope, *parameter.declared, scope.prefix + pass.name + "." + parameter.name);
        model.parameters.back().named = true;
      }
  }
  model.sets += desc.sets.size();
  const std::tuple<std::size_t, std::uint64_t, const char*> bounds[] = {
      {model.parameters.size(), kMaxNames, "parameters"},
      {model.lets.size(), kMaxLets, "lets"},
      {model.entities.size(), kMaxNames, "resources"},
      {model.sets, kMaxNames, "values in \"set\""}};
  for (const auto& [count, bound, what] : bounds)
    if (count > text::raised(bound))
      return stopAt(model, model.desc.place, fmt::format("the graph has too many {}", what), bound, what);
}

// Of an include: an input takes the whole of a resource, an import one of its kind, and of its type where the file declares it and so has arguments for it.
void checkBinds(Model& model, Scope& scope) {
  const IncludeDesc& include = *scope.stanza->include;
  for (const auto& [name, ref] : include.binds) {
    if (includeBound(*scope.parent, name, ref)) continue;
    const ResourceDesc* const own = findNamed(scope.desc->resources, name);
    const ImportType* const type = importTypeOf(model, *scope.desc, name);
    // A file that cannot be read was reported: it may be what is bound.
    if (!scope.parent->broken && (!own || !isInput(*own)) && !type) {
      std::vector<std::string> inputs;
      for (const ResourceDesc& resource : scope.desc->resources)
        if (isInput(resource)) inputs.push_back(resource.name);
      report(model, say::bindsNoInput, ref.place, include.as, name, include.file,
             text::nearestHint(name, inputs));
    }
    if (!isWhole(ref)) report(model, say::bindsMoreThanName, ref.place, include.as, name, ref.text, ref.name);
    const std::uint32_t bound =
        type ? findEntityOrReport(model, *scope.parent, ref, "\"bind\"", "names") : kNone;
    if (bound == kNone) continue;
    const Entity& entity = model.entities[bound];
    const ImportType* given = entity.kind != ResourceDesc::Kind::import
                                  ? nullptr
                                  : findNamed(model.registry.imports,
                                              entity.desc ? entity.desc->import.type : entity.name.substr(1));
    if (!given || given->kind != type->kind || (own && given != type))
      report(model, say::bindsOtherImport, ref.place, include.as, name, ref.text, type->name);
  }
}

// A file with inputs that is opened by itself has nothing behind them.
void reportToInclude(Model& model) {
  const auto needed = [](const ResourceDesc& each) { return isInput(each) && !each.optional; };
  const auto first = std::ranges::find_if(model.desc.resources, needed);
  if (first == model.desc.resources.end()) return;
  model.toInclude = true;
  const std::string file = std::filesystem::path(model.desc.path).filename().string();
  report(model, say::fileToInclude, first->place, file, first->name);
}

// Counts the alternatives that a list leads to, those of lists in it counted. Reports lists that lead back to themselves or to
// too many: everything that follows lists later may visit each of these for each slot.
void followList(Model& model, std::uint32_t index, std::uint64_t& count) {
  Entity& entity = model.entities[index];
  if (entity.kind != ResourceDesc::Kind::alternatives || entity.state == Progress::failed) return;
  const Evaluation evaluation(model, entity.state, "'" + entity.name + "'", entity.desc->place,
                              ~std::size_t{0});
  if (!evaluation.good()) return;
  for (const std::uint32_t candidate : entity.candidates) {
    if (candidate == kNone || model.stopped) continue;
    if (++count > text::raised(kMaxAlternatives))
      return stopAt(model, entity.desc->place, fmt::format("'{}' has too many alternatives", entity.name),
                    kMaxAlternatives, "alternatives of one list, those of lists in it counted");
    followList(model, candidate, count);
  }
  if (entity.state == Progress::failed)
    entity.candidates.assign(entity.candidates.size(), kNone);
  else
    entity.state = Progress::done;
}

void linkAlternatives(Model& model) {
  for (Entity& entity : model.entities) {
    if (entity.kind != ResourceDesc::Kind::alternatives) continue;
    for (const RefDesc& ref : entity.desc->alternatives) {
      if (isOver(model)) return;
      entity.candidates.push_back(findEntityOrReport(model, *entity.scope, ref, "a list of alternatives",
                                                     "names", {}, &entity.samples.emplace_back()));
    }
  }
  for (std::uint32_t i = 0; i < model.entities.size() && !model.stopped; ++i) {
    std::uint64_t count = 0;
    followList(model, i, count);
  }
}

// Calls see(variable) for each $variable of the expression until it returns true; whether it did.
template <class See>
bool anyVariable(Model& model, Scope& scope, const Expr& expr, See&& see) {
  if (!expr.present() || expr.isConstant()) return false;
  return std::ranges::any_of(expr.variables(),
                             [&](const std::string& name) { return see(findVariable(model, scope, name)); });
}

bool anyLet(Model& model, Scope& scope, const Expr& expr, bool Let::*flag) {
  return anyVariable(model, scope, expr, [&](const Variable& used) {
    return used.kind == Variable::Kind::let && model.lets[used.index].*flag;
  });
}

// Sets `flag` of the lets for which `holds`, and of all that use them, perhaps through others. There are at most 256.
template <class Holds>
void spread(Model& model, bool Let::*flag, Holds&& holds) {
  for (Let& let : model.lets) let.*flag = holds(let);
  for (bool more = true; more;) {
    more = false;
    for (Let& let : model.lets)
      if (!(let.*flag) && anyLet(model, *let.scope, let.desc->expr, flag)) more = let.*flag = true;
  }
}

}  // namespace

void buildScopes(Model& model) {
  Scope& root = model.scopes.emplace_back();
  root.desc = &model.desc;
  buildScope(model, root);
  if (model.stopped) return;
  for (const ImportType& type : model.registry.imports) {
    root.imports.emplace(type.name, static_cast<std::uint32_t>(model.entities.size()));
    model.entities.push_back({.kind = ResourceDesc::Kind::import, .scope = &root, .name = "@" + type.name});
  }
  for (std::size_t i = 1; i < model.scopes.size(); ++i) checkBinds(model, model.scopes[i]);
  reportToInclude(model);
  spread(model, &Let::dynamic, [](const Let& let) { return let.desc->expr.dynamic(); });
  spread(model, &Let::watched, [](const Let& let) { return let.desc->expr.watched(); });
  noteMentions(model);
  spread(model, &Let::live,
         [&](const Let& let) { return let.watched || isLive(model, *let.scope, let.desc->expr); });
  linkAlternatives(model);
}

// ---- resources ----

namespace {

// What stands behind an input; the input itself, which becomes a list of none, where it may be left out. kNone after a report.
std::uint32_t boundTo(Model& model, Entity& input, std::uint32_t index) {
  Scope* const parent = input.scope->parent;
  const std::string& name = input.desc->name;
  const Behind from = parent ? behindInput(model, input) : Behind{};
  const RefDesc *const bind = from.bind, *sample = nullptr;
  const std::uint32_t target =
      bind     ? findEntityOrReport(model, *parent, *bind, "\"bind\"", "names", {}, &sample)
      : parent ? findEntity(model, *from.scope, name, false, &sample)
               : kNone;
  if (target == kNone && !bind && parent && !input.desc->optional && mendDeclarations(model))
    return boundTo(model, input, index);
  if (!input.sample) input.sample = sample;
  if (target != kNone) return target;
  // One of the includer's own that has nothing behind it was reported there, as was a file that cannot be read and may have one, and
  // those of the root by reportToInclude().
  if (bind || (parent && (parent->resources.contains(name) || parent->broken))) return kNone;
  if (input.desc->optional) {
    input.kind = ResourceDesc::Kind::alternatives;
    input.state = Progress::done;
    return index;
  }
  if (parent)
    report(model, say::unboundInput, input.scope->stanza->place, input.scope->stanza->include->as, name,
           suffixHint(name, resourceNames(model, *parent)), input.name);
  return kNone;
}

// Follows inputs to what is bound. kNone after a report.
std::uint32_t followInput(Model& model, std::uint32_t index) {
  Entity& entity = model.entities[index];
  if (entity.kind != ResourceDesc::Kind::input) return index;
  if (entity.state == Progress::done || entity.state == Progress::failed) return entity.bound;
  const Evaluation evaluation(model, entity.state, "'" + entity.name + "'", entity.desc->place);
  if (!evaluation.good()) return kNone;
  entity.bound = boundTo(model, entity, index);
  entity.state = entity.bound == kNone ? Progress::failed : Progress::done;
  return entity.bound;
}

// An import declared under `name`, or bound to it, here or in an enclosing file, else one of that type with its defaults.
std::uint32_t findImport(Model& model, const Scope& from, std::string_view name) {
  for (const Scope* scope = &from; scope; scope = scope->parent) {
    if (const auto found = scope->resources.find(name); found != scope->resources.end())
      if (model.entities[found->second].kind == ResourceDesc::Kind::import) return found->second;
    if (const std::uint32_t bound = findBoundImport(model, *scope, name); bound != kNone) return bound;
  }
  for (const Scope* scope = &from; scope; scope = scope->parent)
    if (const auto own = scope->imports.find(name); own != scope->imports.end()) return own->second;
  return kNone;
}

}  // namespace

Behind behindInput(const Model& model, const Entity& input) {
  Scope& parent = *input.scope->parent;
  const std::string& name = input.desc->name;
  Behind behind{&parent, name};
  for (const auto& [own, ref] : input.scope->stanza->include->binds) {
    Scope* const include = includeBound(parent, own, ref);
    if (!include && own == name) return {&parent, ref.name, ref.import, &ref};
    if (include && behind.scope == &parent && hasOwn(model, *include, name)) behind.scope = include;
  }
  return behind;
}

std::string_view firstPart(std::string_view name) {
  return name.substr(0, name.find('.'));
}

Scope& scopeOf(Scope& scope, std::string_view& name) {
  const std::size_t dot = name.find('.');
  const auto child =
      dot == std::string_view::npos ? scope.includes.end() : scope.includes.find(name.substr(0, dot));
  if (child == scope.includes.end()) return scope;
  name.remove_prefix(dot + 1);
  return scopeOf(*child->second, name);
}

Scope* includeBound(Scope& scope, std::string_view input, const RefDesc& ref) {
  std::string_view name = ref.name;
  Scope& in = scopeOf(scope, name);
  const auto include = name == input ? in.includes.find(name) : in.includes.end();
  const bool whole = include != in.includes.end() && !ref.import && isWhole(ref);
  return whole && !scope.resources.contains(ref.name) ? include->second : nullptr;
}

std::uint32_t findEntity(Model& model, Scope& scope, std::string_view name, bool import,
                         const RefDesc** sample) {
  if (name.starts_with('@')) return findEntity(model, scope, name.substr(1), true, sample);
  const Scope* in = &scope;
  std::uint32_t found = kNone, own = kNone;
  if (import && name.find('.') == std::string_view::npos) {
    found = own = findImport(model, scope, name);
  } else {
    in = &scopeOf(scope, name);
    if (const auto there = in->resources.find(name); there != in->resources.end()) {
      own = there->second;
      found = followInput(model, own);
    }
    if (found != kNone && import && model.entities[found].kind != ResourceDesc::Kind::import) found = kNone;
  }
  if (sample && found != kNone) *sample = model.entities[own].sample;
  return found;
}

std::vector<std::string> resourceNames(const Model& model, const Scope& scope) {
  std::vector<std::string> names;
  for (const Entity& each : model.entities)
    if (each.desc && each.name.starts_with(scope.prefix) && (each.scope == &scope || !isInput(*each.desc)))
      names.push_back(each.name.substr(scope.prefix.size()));
  return names;
}

namespace {

bool sees(const Scope& a, const Scope& b) {
  return a.prefix.starts_with(b.prefix) || b.prefix.starts_with(a.prefix);
}

// The name that a misspelt declaration is meant to have, after a report; null when it is not misspelt.
const std::string* nameMeant(Model& model, Model::Asked::Kind kind, const Scope& scope, std::string_view name,
                             const Place& place) {
  constexpr std::size_t kShortest = 3;  // shorter names are near to each other by chance
  const bool resource = kind == Model::Asked::Kind::resource;
  const auto isNear = [&](const Model::Asked& each) {
    return each.kind == kind && each.name.size() >= kShortest &&
           text::editDistance(each.name, name, 1) <= 1 &&
           (resource ? each.scope == &scope && !scope.includes.contains(each.name)
                     : sees(*each.scope, scope));
  };
  std::map<std::string_view, int> asked;
  for (const Model::Asked& each : std::views::filter(model.asked, isNear)) ++asked[each.name];
  const auto meant = std::ranges::find_if(asked, [](const auto& each) { return each.second > 1; });
  if (meant == asked.end() || isOver(model)) return nullptr;
  using Misspelt = text::SentenceFor<std::string_view, std::string_view, int>;
  const Misspelt what = resource                           ? Misspelt(say::nothingNamesResource)
                        : kind == Model::Asked::Kind::pass ? Misspelt(say::passAskedUnderOtherName)
                                                           : Misspelt(say::nothingNamesVariable);
  reportChecked(model, what, place, name, meant->first, meant->second);
  const std::string& known = model.misspelt.emplace_back(meant->first);
  std::erase_if(model.asked, [&](const auto& each) { return each.name == known && isNear(each); });
  return &known;
}

}  // namespace

bool mendDeclarations(Model& model) {
  using enum Model::Asked::Kind;
  if (std::exchange(model.mended, true)) return false;
  for (Scope& scope : model.scopes) {
    // In the file of the declaration, and where it is found from above.
    const auto alsoCall = [&](std::string_view name, const Variable& found) {
      declare(scope, model.misspelt.emplace_back(scope.prefix).append(name), found);
      for (Scope* outer = scope.parent; outer; outer = outer->parent) outer->meant[std::string(name)] = found;
    };
    for (const ResourceDesc& each : scope.desc->resources)
      if (const std::uint32_t index = scope.resources.at(each.name);
          !isNamed(model.entities, model.entities[index]))
        if (const auto* name = nameMeant(model, resource, scope, each.name, each.place))
          scope.resources.try_emplace(*name, index);
    for (const auto& [own, found] : KnownNames<Variable>(scope.variables)) {
      const auto mend = [&](const auto& all) {
        const auto& declared = all[found.index];
        if (!isNamed(all, declared))
          if (const auto* name = nameMeant(model, variable, scope, own, declared.desc->place))
            alsoCall(*name, found);
      };
      if (own.find('.') == std::string_view::npos)  // of this file
        found.kind == Variable::Kind::let ? mend(model.lets) : mend(model.parameters);
    }
    for (const auto& [own, stanza] : scope.passes)
      if (const auto* name = nameMeant(model, pass, scope, own, stanza->namePlace))
        for (const auto& [path, found] : KnownNames<Variable>(scope.variables))
          if (firstPart(path) == own && path != own)
            alsoCall(model.misspelt.emplace_back(*name).append(path.substr(own.size())), found);
  }
  return true;
}

namespace {

// The fix for a resource that is not there.
std::string hintForResource(const Model& model, const Scope& scope, std::string_view name) {
  // A whole name in its own file.
  if (!scope.prefix.empty() && name.starts_with(scope.prefix)) name.remove_prefix(scope.prefix.size());
  if (findNamed(model.registry.imports, name)) return fmt::format("did you mean the import '@{}'?", name);
  for (const Scope* outer = scope.parent; outer; outer = outer->parent)
    if (outer->resources.contains(name) || outer->includes.contains(firstPart(name)))
      return fmt::format("the including file has it: write \"inputs\": [\"{}\"] in the file of the pass",
                         name.substr(name.rfind('.') + 1));
  return suffixHint(name, resourceNames(model, scope));
}

}  // namespace

std::string whoIs(std::string_view user, std::string_view pass) {
  return pass.empty() ? std::string(user) : fmt::format("pass '{}'", pass);
}

std::uint32_t findEntityOrReport(Model& model, Scope& scope, const RefDesc& ref, std::string_view who,
                                 std::string_view verb, std::string_view pass, const RefDesc** sample) {
  const std::string& name = ref.name;
  const bool import = ref.import;
  const std::size_t before = model.diagnostics.errorCount();
  const std::uint32_t found = findEntity(model, scope, name, import, sample);
  if (found != kNone || isOver(model) || model.diagnostics.errorCount() > before) return found;
  if (!import && mendDeclarations(model))
    return findEntityOrReport(model, scope, ref, who, verb, pass, sample);
  // Its declaration was reported, or it is an input with nothing behind it, which was.
  const bool own = scope.resources.contains(name);
  if (isUnread(scope, name) || (!import && own)) return kNone;
  std::string hint = !import ? hintForResource(model, scope, name)
                     : own   ? fmt::format("'{}' is a resource of this graph: write it without the @", name)
                             : hintForImport(model.registry, name);
  // A file that is not included is one mistake, however many of its names are used.
  const std::string first(firstPart(name));
  if (!import && first.size() < name.size() && !scope.includes.contains(first) &&
      !scope.resources.contains(first) && !scope.passes.contains(first)) {
    if (!model.unincluded.emplace(&scope, first).second) return kNone;
    if (hint.empty())
      hint = fmt::format("include a file as that: {{ \"include\": …, \"as\": \"{}\" }}", first);
  }
  import ? report(model, say::unknownImport, ref.place, whoIs(who, pass), verb, name, hint, pass)
         : report(model, say::unknownResource, ref.place, whoIs(who, pass), verb, name, hint, pass);
  return kNone;
}

std::uint32_t findBoundImport(Model& model, const Scope& scope, std::string_view name) {
  if (!scope.parent) return kNone;
  const auto& binds = scope.stanza->include->binds;
  const auto bind = std::ranges::find(binds, name, &std::pair<std::string, RefDesc>::first);
  const std::uint32_t found =
      bind == binds.end() ? kNone : findEntity(model, *scope.parent, bind->second.name, bind->second.import);
  return found != kNone && model.entities[found].kind == ResourceDesc::Kind::import ? found : kNone;
}

std::uint32_t findFileView(Model& model, Scope& scope) {
  for (const ImportType& type : model.registry.imports) {
    const std::uint32_t view = type.everyPass ? findEntity(model, scope, type.name, true) : kNone;
    if (view != kNone && model.entities[view].desc && ensureShape(model, view)) return view;
  }
  return kNone;
}

std::uint32_t findDeclared(Model& model, Scope& scope, std::string_view name, ImportKind kind) {
  const std::uint32_t found = name.empty() ? kNone : findEntity(model, scope, name, true);
  if (found == kNone || !model.entities[found].desc) return kNone;
  const ImportType* type = findNamed(model.registry.imports, model.entities[found].desc->import.type);
  return type && type->kind == kind ? found : kNone;
}

std::uint32_t findAsked(Model& model, Scope& scope, std::string_view name) {
  const std::uint32_t found = findEntity(model, scope, name, false);
  // An input with nothing behind it is no import of its name.
  return found == kNone && !scope.resources.contains(name) ? findEntity(model, scope, name, true) : found;
}

std::pair<const PassDesc*, Scope*> findAskedPass(Scope& scope, std::string_view name) {
  Scope& in = scopeOf(scope, name);
  const auto found = in.passes.find(name);
  return {found == in.passes.end() ? nullptr : found->second, &in};
}

bool isUnread(const Scope& from, std::string_view name) {
  if (from.broken) return true;
  if (const auto child = from.includes.find(firstPart(name));
      child != from.includes.end() && name.find('.') != std::string_view::npos)
    return isUnread(*child->second, name.substr(name.find('.') + 1));
  const std::string_view leaf = name.substr(name.rfind('.') + 1);
  for (const Scope* scope = &from; scope; scope = scope->parent) {
    const auto& unread = scope->desc->unread;
    if ((scope->broken && leaf != name) || std::ranges::find(unread, leaf) != unread.end()) return true;
  }
  return false;
}

// ---- variables ----

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

Variable findVariable(const Model& model, const Scope& from, std::string_view name) {
  for (const Scope* scope = &from; scope; scope = scope->parent)
    if (const auto own = scope->variables.find(name); own != scope->variables.end()) return own->second;
  if (const auto known = from.meant.find(name); known != from.meant.end()) return known->second;
  Variable found;
  if (const std::vector<std::uint32_t> meant = parametersMeant(model, from.prefix, name); !meant.empty())
    found = {meant.size() == 1 ? Variable::Kind::parameter : Variable::Kind::ambiguous, meant[0]};
  from.meant.emplace(name, found);
  return found;
}

// ---- what expressions depend on ----

void checkExpr(Model& model, Scope& scope, const Expr& expr, std::span<const RangeDesc> repeat) {
  if (!expr.present() || expr.isConstant()) return;
  Names names(model, scope);
  names.checking = true;
  for (const RangeDesc& range : repeat) names.indices.push_back({range.index, 0});
  expr.check(names, model.diagnostics);
}

bool countsElements(Model& model, Scope& scope, const Expr& expr) {
  const auto counts = [](const auto& fact) { return fact.first == Fact::count || fact.first == Fact::has; };
  return expr.present() && (std::ranges::any_of(expr.facts(), counts) ||
                            anyVariable(model, scope, expr, [&](const Variable& used) {
                              if (used.kind != Variable::Kind::let) return false;
                              const Let& let = model.lets[used.index];
                              return countsElements(model, *let.scope, let.desc->expr);
                            }));
}

bool isDynamic(Model& model, Scope& scope, const Expr& expr) {
  return expr.dynamic() || anyLet(model, scope, expr, &Let::dynamic);
}

bool isWatched(Model& model, Scope& scope, const Expr& expr) {
  return expr.watched() || anyLet(model, scope, expr, &Let::watched);
}

bool isLive(Model& model, Scope& scope, const Expr& expr) {
  return anyLet(model, scope, expr, &Let::live) || anyVariable(model, scope, expr, [&](const Variable& used) {
           return used.kind == Variable::Kind::parameter && !model.parameters[used.index].structural;
         });
}

void markStructural(Model& model, Scope& scope, const Expr& expr) {
  anyVariable(model, scope, expr, [&](const Variable& used) {
    if (used.kind == Variable::Kind::parameter) model.parameters[used.index].structural = true;
    if (used.kind == Variable::Kind::let && !std::exchange(model.lets[used.index].structural, true)) {
      const Let& let = model.lets[used.index];
      markStructural(model, *let.scope, let.desc->expr);
    }
    return false;
  });
}

}  // namespace weft::graph::expansion
