// Warnings about what the files declare and nothing uses: W089. Which passes run is not looked at. Declared in judge.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "engine/graph/expand/judge/judge.h"
#include "engine/graph/expand/names/names.h"
#include "graph_sentences.h"

namespace weft::graph::expansion {

namespace {

// Whether nothing may have been laid over the file since this was written there.
bool isOnTop(const Scope& scope, const Place& place) {
  for (const Scope* outer = scope.parent; outer; outer = outer->parent)
    if (!outer->desc->top.empty()) return false;
  return scope.desc->top.empty() || (place.file && *place.file == scope.desc->top);
}

// ---- parameters and lets ----

void warnOfVariables(Model& model) {
  for (const Parameter& parameter : model.parameters) {
    const std::string& name = parameter.desc->name;
    if (!isNamed(model.parameters, parameter) && isOnTop(*parameter.scope, parameter.desc->place))
      warn(model, say::unusedParameter, parameter.desc->place, name);
  }
  for (const Let& let : model.lets)  // an including file may want one
    if (!let.named && !let.scope->parent && isOnTop(*let.scope, let.desc->place))
      warn(model, say::unusedLet, let.desc->place, let.desc->name);
}

// ---- resources ----

// A view that is declared under the name of its type is that of all passes.
bool servesAll(const Model& model, const ResourceDesc& resource) {
  const ImportType* type = resource.kind == ResourceDesc::Kind::import
                               ? findNamed(model.registry.imports, resource.import.type)
                               : nullptr;
  return type && type->everyPass && type->name == resource.name;
}

void warnOfResource(Model& model, const Entity& entity) {
  const ResourceDesc& resource = *entity.desc;
  const GraphDesc& file = *entity.scope->desc;
  const std::string& name = resource.name;
  const bool input = resource.kind == ResourceDesc::Kind::input;
  // Files that include this one may read what it keeps: it presents nothing, or just that.
  const bool mayBeReadAbove = entity.scope->parent || !file.present || file.present->name == name;
  if (!isNamed(model.entities, entity) && !servesAll(model, resource))
    warn(model, say::unusedResource, resource.place, input ? "input" : "resource", name,
         input ? "this file" : "the graph");
  else if (resource.history.present() && !entity.lookedBackAt && !mayBeReadAbove)
    warn(model, say::unusedHistory, resource.history.place(), name);
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
    warn(model, say::unreachableAlternative, later->place, list.desc->name, later->text, refs[i].text,
         pass->name, list.name);
    return;
  }
}

// ---- lists of the scene ----

// Things of the scene whose author put them into lists, of which the graph draws others only.
void warnOfSceneLists(Model& model) {
  if (!model.desc.top.empty() || model.registry.things.empty()) return;
  std::set<std::string> drawn;
  for (const Scope& scope : model.scopes)
    for (const PassDesc& pass : scope.desc->passes)
      if (!pass.list.empty()) drawn.insert(pass.list);
  if (drawn.empty()) return;  // it shows no things
  for (const ImportSpec& import : model.graph.imports) {
    if (import.kind == ImportKind::list) return;  // it chooses things by more than their lists
    const ImportType* type = findNamed(model.registry.imports, import.request.type);
    if (std::ranges::count(model.registry.drawLists, import.request.type) > 0)
      drawn.insert(import.request.type);  // its rows
    for (std::size_t i = 0; type && i < import.request.arguments.size() && i < type->arguments.size(); ++i)
      if (type->arguments[i].drawList) drawn.insert(import.request.arguments[i].second.symbol);
  }
  for (const Registry::Things& things : model.registry.things)
    if (std::ranges::none_of(things.lists, [&](const std::string& list) { return drawn.contains(list); }))
      warn(model, say::listNotDrawn, model.desc.place,
           things.count == 1 ? "a thing" : fmt::format("{} things", things.count),
           things.lists.size() == 1 ? "" : "s", fmt::join(things.lists, "', '"), model.desc.name,
           things.lists[0], fmt::join(drawn, ", "));
}

}  // namespace

void warnUnused(Model& model) {
  warnOfSceneLists(model);
  warnOfVariables(model);
  for (const Scope& scope : model.scopes)
    for (const auto& [name, place] : scope.desc->slotSets) {
      const auto uses = [&name = name](const PassDesc& pass) {
        return findNamed(pass.uses, name) != nullptr;
      };
      if (scope.desc->unread.empty() && std::ranges::none_of(scope.desc->passes, uses) &&
          isOnTop(scope, place))
        warn(model, say::unusedSet, place, name);
    }
  for (const Entity& entity : model.entities) {
    if (!entity.desc || !isOnTop(*entity.scope, entity.desc->place)) continue;
    warnOfResource(model, entity);
    if (entity.kind == ResourceDesc::Kind::alternatives) warnOfList(model, entity);
  }
}

}  // namespace weft::graph::expansion
