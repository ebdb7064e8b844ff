// Warnings about what the files declare and nothing uses: W089. Which passes run is not looked at. Declared in judge.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "engine/graph/desc_walk.h"
#include "engine/graph/expand/judge/judge.h"
#include "engine/graph/expand/names/names.h"
#include "engine/graph/language/expr_node.h"

namespace weft::graph::expansion {

namespace {

// Whether nothing may have been laid over the file since this was written there.
bool isOnTop(const Scope& scope, const Place& place) {
  for (const Scope* outer = scope.parent; outer; outer = outer->parent)
    if (!outer->desc->top.empty()) return false;
  return scope.desc->top.empty() || (place.file && *place.file == scope.desc->top);
}

text::Diagnostic& warnAt(Model& model, const Place& place, std::string message, std::string hint,
                         const std::string& resource = "") {
  auto& d = model.diagnostics.warning(Code::unusedDeclaration, place, std::move(message));
  d.hint = std::move(hint);
  d.resource = resource;
  return d;
}

// Which levels, layers or elements all references to a resource select.
struct Selected {
  bool several = false;
  std::string one;  // the only one so far, as written; empty: no reference so far

  // A number; nothing for all of them, several, or one that depends on something.
  void add(const Expr* first, const Expr* last) {
    const auto textOf = [](const Expr* expr) {
      return expr && expr->present() && expr->isConstant() ? expr->text() : std::string();
    };
    const std::string which = textOf(first);
    several = several || which.empty() || textOf(last) != which || (!one.empty() && one != which);
    one = which;
  }
  void add(const std::optional<SpanDesc>& span) {
    add(span ? &span->first : nullptr, span ? (span->range ? &span->last : &span->first) : nullptr);
  }
};

// What the expressions and references of all files name, whatever the conditions say now. A file may be included twice, so
// what is named is a declaration.
class Mentions {
 public:
  struct Parts {
    Selected level, layer, element;
  };
  std::unordered_set<const void*> named, lookedBackAt;  // parameters, lets and resources; resources
  std::set<std::string_view> below;  // last parts of names that are looked for in included files
  std::unordered_map<const ResourceDesc*, Parts> parts;

  explicit Mentions(Model& model) : model_(model), walked_(model.entities.size(), 0) {
    for (Scope& scope : model_.scopes) {
      const auto addExpr = [&](const Expr& expr) {
        if (expr.present()) add(scope, *expr.root());
      };
      const auto addRef = [&](const RefDesc& ref) { add(scope, ref); };
      visitMentions(*scope.desc, addExpr, addRef);
      for (const ResourceDesc& resource : scope.desc->resources)
        for (const NamedExpr& argument : resource.import.arguments)
          if (argument.expr.present() && argument.expr.root()->op == ExprOp::identifier)
            add(find(scope, argument.expr.root()->name, true), false);
      for (const PassDesc& pass : scope.desc->passes) add(find(scope, pass.list, true), false);
      for (const PassDesc& pass : scope.desc->passes)
        if (pass.include)
          for (const auto& [input, ref] : pass.include->binds) visitRef(ref, addExpr, addRef);
    }
  }

 private:
  void add(Scope& scope, const ExprNode& node) {
    if (node.op == ExprOp::fact) {
      add(find(scope, node.name, false), false);
    } else if (node.op == ExprOp::variable) {
      const Variable found = findVariableFrom(scope, node.name);
      if (found.kind == Variable::Kind::parameter)
        named.insert(model_.parameters[found.index].desc);
      else if (found.kind == Variable::Kind::let)
        named.insert(model_.lets[found.index].desc);
      else
        below.insert(std::string_view(node.name).substr(node.name.rfind('.') + 1));
    }
    for (const ExprPtr& child : node.children) add(scope, *child);
  }

  void add(Scope& scope, const RefDesc& ref) {
    const std::uint32_t found = add(find(scope, ref.name, ref.import), ref.history > 0);
    if (found == kNone || ref.import) return;
    Parts& selected = parts[model_.entities[found].desc];
    selected.level.add(ref.mip);
    selected.layer.add(ref.layer);
    selected.element.add(ref.element ? &*ref.element : nullptr, ref.element ? &*ref.element : nullptr);
  }

  // What a name means as it is written: an input is itself. kNone for what no file declares.
  std::uint32_t find(const Scope& scope, std::string_view name, bool import) const {
    if (name.starts_with('@')) return find(scope, name.substr(1), true);
    for (const Scope* at = &scope; at; at = import ? at->parent : nullptr)
      if (const auto found = at->resources.find(name); found != at->resources.end())
        if (!import || model_.entities[found->second].kind == ResourceDesc::Kind::import)
          return found->second;
    const std::size_t dot = name.find('.');
    if (dot == std::string_view::npos) return kNone;
    const auto child = scope.includes.find(name.substr(0, dot));
    return child == scope.includes.end() ? kNone : find(*child->second, name.substr(dot + 1), false);
  }

  // An input, and all that is bound to it, the last of which is returned; of what is looked back at also what the list may mean.
  std::uint32_t add(std::uint32_t index, bool back) {
    if (index == kNone || !model_.entities[index].desc) return kNone;
    const Entity& entity = model_.entities[index];
    const std::uint8_t flags = back ? 3 : 1;
    if ((walked_[index] & flags) != flags) {
      walked_[index] |= flags;
      named.insert(entity.desc);
      if (back) lookedBackAt.insert(entity.desc);
      for (const RefDesc& ref : entity.desc->alternatives)
        if (back) add(find(*entity.scope, ref.name, ref.import), true);
    }
    Scope* const parent = entity.scope->parent;
    if (entity.desc->kind != ResourceDesc::Kind::input || !parent) return index;
    const std::string& name = entity.desc->name;
    const auto& binds = entity.scope->stanza->include->binds;
    if (const auto bound = std::ranges::find(binds, name, &std::pair<std::string, RefDesc>::first);
        bound != binds.end() && !includeBound(*parent, name, bound->second))
      return add(find(*parent, bound->second.name, bound->second.import), back);
    for (const auto& [own, ref] : binds)
      if (const Scope* all = includeBound(*parent, own, ref))
        if (const std::uint32_t found = find(*all, name, false); found != kNone) return add(found, back);
    return add(find(*parent, name, false), back);
  }

  Model& model_;
  std::vector<std::uint8_t> walked_;  // per entity: 1 named, 2 looked back at
};

// ---- parameters and lets ----

void warnOfVariables(Model& model, const Scope& scope, const Mentions& mentions) {
  for (const ParameterDesc& parameter : scope.desc->parameters)
    if (!mentions.named.contains(&parameter) && !mentions.below.contains(parameter.name) &&
        isOnTop(scope, parameter.place))
      warnAt(model, parameter.place,
             fmt::format("the parameter '{0}' changes nothing: no expression reads '${0}'", parameter.name),
             fmt::format(
                 "write '${0}' where its value is meant, such as \"parameters\": {{ \"{0}\": \"${0}\" }} "
                 "of a pass, or remove it",
                 parameter.name));
  if (scope.parent) return;  // an including file may want a let
  for (const NamedExpr& let : scope.desc->lets)
    if (!mentions.named.contains(&let) && isOnTop(scope, let.place))
      warnAt(model, let.place,
             fmt::format("the \"let\" '{0}' changes nothing: no expression reads '${0}'", let.name),
             fmt::format("write '${}' where its value is meant, or remove it", let.name));
}

// ---- resources ----

// A view that is declared under the name of its type is that of all passes.
bool servesAll(const Model& model, const ResourceDesc& resource) {
  const ImportType* type = resource.kind == ResourceDesc::Kind::import
                               ? findImportType(model.registry, resource.import.type)
                               : nullptr;
  return type && type->everyPass && type->name == resource.name;
}

void warnOfResource(Model& model, const Scope& scope, const ResourceDesc& resource,
                    const Mentions& mentions) {
  const std::string& name = resource.name;
  const bool input = resource.kind == ResourceDesc::Kind::input;
  // Files that include this one may read what it keeps: it presents nothing, or just that.
  const bool mayBeReadAbove = scope.parent || !scope.desc->present || scope.desc->present->name == name;
  if (!mentions.named.contains(&resource) && !servesAll(model, resource))
    warnAt(model, resource.place,
           fmt::format("the {} '{}' is not used: no pass, list or expression of {} names it",
                       input ? "input" : "resource", name, input ? "this file" : "the graph"),
           fmt::format("name '{}' where it is meant, or remove it", name), name);
  else if (resource.history.present() && !mentions.lookedBackAt.contains(&resource) && !mayBeReadAbove)
    warnAt(model, resource.history.place(),
           fmt::format("'{0}' keeps what it was before, and no pass reads '{0}@-1'", name),
           fmt::format("read '{}@-1' where that is meant, or leave \"history\" out", name), name);
}

void warnOfParts(Model& model, const Entity& entity, const Mentions::Parts& parts) {
  const ResourceDesc& desc = *entity.desc;
  const struct {
    const Selected& selected;
    std::uint32_t count;
    const Expr& said;
    const char *key, *word, *selector;
  } kinds[] = {{parts.level, entity.shape.mips, desc.mips, "mips", "level", ".mip[i]"},
               {parts.element, entity.arrayCount, desc.array, "array", "element", "[i]"},
               {parts.layer, desc.layers.present() ? entity.shape.layers : 0u, desc.layers, "layers", "layer",
                ".layer[i]"}};
  for (const auto& [selected, count, said, key, word, selector] : kinds)
    if (!selected.several && count > 1)
      warnAt(model, said.present() ? said.place() : desc.place,
             fmt::format("'{}' has {} {}s, and all that is written and read is {} {}", entity.name, count,
                         word, word, selected.one),
             fmt::format("leave \"{}\" out, or use the others, such as '{}{}' in a pass with \"repeat\"", key,
                         desc.name, selector),
             entity.name);
}

// A stanza that nothing in the files leaves out.
bool isUnconditional(const Scope& scope, const PassDesc& pass) {
  bool conditional = pass.enabled.present() || !pass.repeat.empty();
  for (const Scope* outer = &scope; outer->stanza; outer = outer->parent)
    conditional = conditional || outer->stanza->enabled.present();
  return !conditional;
}

// The pass that always writes all of it before anybody reads the list, or null.
const PassDesc* alwaysWrites(const Model& model, std::uint32_t candidate, const Entity& list) {
  for (const WriteRecord& write : model.writes) {
    if (write.entity != candidate || write.pass == kNone || !write.whole ||
        write.position >= list.firstRead || list.firstRead == kNone)
      continue;
    const std::string& name = model.graph.specs[write.pass].declared;
    for (const Scope& scope : model.scopes) {
      if (!name.starts_with(scope.prefix)) continue;
      const auto pass = scope.passes.find(std::string_view(name).substr(scope.prefix.size()));
      if (pass != scope.passes.end() && isUnconditional(scope, *pass->second)) return pass->second;
    }
  }
  return nullptr;
}

// An alternative with a condition, behind one that always holds. One without is there for when a pass is switched off.
void warnOfList(Model& model, const Entity& list) {
  const std::vector<RefDesc>& refs = list.desc->alternatives;
  for (std::size_t i = 0; i + 1 < refs.size() && i < list.candidates.size(); ++i) {
    if (refs[i].condition.present() || refs[i].history > 0 || list.candidates[i] == kNone) continue;
    const auto later = std::find_if(refs.begin() + static_cast<std::ptrdiff_t>(i) + 1, refs.end(),
                                    [](const RefDesc& ref) { return ref.condition.present(); });
    const PassDesc* pass = later == refs.end() ? nullptr : alwaysWrites(model, list.candidates[i], list);
    if (!pass) continue;
    warnAt(model, later->place,
           fmt::format("'{}' never means '{}': '{}' stands before it, and pass '{}' always writes that",
                       list.desc->name, later->text, refs[i].text, pass->name),
           fmt::format("put '{}' before '{}', or remove it", later->text, refs[i].text), list.name);
    return;
  }
}

// ---- lists of the scene ----

// Things of the scene whose author put them into lists, of which the graph draws others only.
void warnOfSceneLists(Model& model) {
  if (!model.desc.top.empty()) return;
  std::set<std::string> drawn;
  for (const Scope& scope : model.scopes)
    for (const PassDesc& pass : scope.desc->passes)
      if (!pass.list.empty()) drawn.insert(pass.list);
  if (drawn.empty()) return;  // it shows no things
  for (const ImportSpec& import : model.graph.imports) {
    if (import.kind == ImportKind::list) return;  // it chooses things by more than their lists
    const ImportType* type = findImportType(model.registry, import.request.type);
    for (std::size_t i = 0; type && i < import.request.arguments.size() && i < type->arguments.size(); ++i)
      if (type->arguments[i].drawList) drawn.insert(import.request.arguments[i].second.symbol);
  }
  for (const Registry::Things& things : model.registry.things)
    if (std::ranges::none_of(things.lists, [&](const std::string& list) { return drawn.contains(list); }))
      warnAt(
          model, model.desc.place,
          fmt::format("the scene has {} in the list{} '{}', which no pass of '{}' draws",
                      things.count == 1 ? "a thing" : fmt::format("{} things", things.count),
                      things.lists.size() == 1 ? "" : "s", fmt::join(things.lists, "', '"), model.desc.name),
          fmt::format("add a pass with \"list\": \"{}\", or put them into a list that is drawn: {}",
                      things.lists[0], fmt::join(drawn, ", ")));
}

}  // namespace

void warnUnused(Model& model) {
  const Mentions mentions(model);
  warnOfSceneLists(model);
  for (const Scope& scope : model.scopes) {
    warnOfVariables(model, scope, mentions);
    for (const ResourceDesc& resource : scope.desc->resources)
      if (isOnTop(scope, resource.place)) warnOfResource(model, scope, resource, mentions);
    for (const auto& [name, place] : scope.desc->slotSets) {
      const auto uses = [&](const PassDesc& pass) {
        return std::ranges::find(pass.uses, name, &UsedSet::name) != pass.uses.end();
      };
      if (scope.desc->unread.empty() && std::ranges::none_of(scope.desc->passes, uses) &&
          isOnTop(scope, place))
        warnAt(model, place, fmt::format("the set '{}' is in no pass", name),
               fmt::format("write \"use\": \"{}\" in a pass of this file, or remove it", name));
    }
  }
  for (const Entity& entity : model.entities) {
    if (!entity.desc || !isOnTop(*entity.scope, entity.desc->place)) continue;
    const auto parts = mentions.parts.find(entity.desc);
    if (entity.kind == ResourceDesc::Kind::alternatives)
      warnOfList(model, entity);
    else if (parts != mentions.parts.end() && entity.kind <= ResourceDesc::Kind::buffer)
      warnOfParts(model, entity, parts->second);
  }
}

}  // namespace weft::graph::expansion
