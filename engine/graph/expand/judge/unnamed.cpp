#include "engine/graph/expand/judge/unnamed.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "engine/base/nearest.h"
#include "engine/graph/desc_walk.h"
#include "engine/graph/expand/judge/unused.h"
#include "engine/graph/expand/names/resources.h"
#include "engine/graph/expand/names/scope.h"

namespace weft::graph::expansion {

namespace {

// The declarations that the files name, whatever the conditions say now.
class Named {
 public:
  explicit Named(Model& model) : model_(model), walked_(model.entities.size(), 0) {
    for (Scope& scope : model_.scopes) addFile(scope);
    for (std::size_t i = 0; i < walked_.size(); ++i) {
      if (walked_[i] != 0) named_.push_back(model_.entities[i].desc);
      if ((walked_[i] & kBack) != 0) looksBack_.push_back(model_.entities[i].desc);
    }
    std::ranges::sort(named_);
    std::ranges::sort(looksBack_);
  }

  bool has(const ResourceDesc& resource) const { return std::ranges::binary_search(named_, &resource); }
  bool looksBack(const ResourceDesc& resource) const {
    return std::ranges::binary_search(looksBack_, &resource);
  }

 private:
  static constexpr std::uint8_t kNow = 1, kBack = 2;

  void addFile(Scope& scope) {
    visitMentions(
        *scope.desc, [&](const Expr& expr) { add(scope, expr); },
        [&](const RefDesc& ref) { add(scope, ref); });
    for (const PassDesc& pass : scope.desc->passes)
      if (pass.include)
        for (const auto& [input, ref] : pass.include->binds) {
          add(scope, ref.condition);
          add(scope, ref);
        }
  }

  void add(Scope& scope, const Expr& expr) {
    if (!expr.present() || expr.isConstant()) return;
    for (const auto& [fact, name] : expr.facts()) nameOne(scope, name, false, false);
  }

  void add(Scope& scope, const RefDesc& ref) { nameOne(scope, ref.name, ref.import, ref.history > 0); }

  // As findEntity() does, but with everything on the way: an input, and what is bound to it.
  void nameOne(Scope& scope, std::string_view name, bool import, bool back) {
    if (!name.empty() && name[0] == '@') return nameOne(scope, name.substr(1), true, back);
    for (Scope* at = &scope; at; at = import ? at->parent : nullptr)
      if (const auto found = at->resources.find(name); found != at->resources.end()) {
        const Entity& entity = model_.entities[found->second];
        if (!import || entity.kind == ResourceDesc::Kind::import) return take(found->second, back);
      }
    const std::size_t dot = name.find('.');
    if (dot == std::string_view::npos) return;
    if (const auto child = scope.includes.find(name.substr(0, dot)); child != scope.includes.end())
      nameOne(*child->second, name.substr(dot + 1), false, back);
  }

  void take(std::uint32_t index, bool back) {
    const std::uint8_t how = back ? kBack : kNow;
    if ((walked_[index] & how) != 0) return;
    walked_[index] = static_cast<std::uint8_t>(walked_[index] | how);
    const ResourceDesc& resource = *model_.entities[index].desc;
    Scope& scope = *model_.entities[index].scope;
    if (back)
      for (const RefDesc& ref : resource.alternatives) nameOne(scope, ref.name, ref.import, true);
    if (resource.kind != ResourceDesc::Kind::input || !scope.parent) return;
    const auto& binds = scope.stanza->include->binds;
    const auto bound = std::ranges::find(binds, resource.name, &std::pair<std::string, RefDesc>::first);
    if (bound == binds.end())
      nameOne(*scope.parent, resource.name, false, back);
    else
      nameOne(*scope.parent, bound->second.name, bound->second.import, back);
  }

  Model& model_;
  std::vector<std::uint8_t> walked_;                    // per entity
  std::vector<const ResourceDesc*> named_, looksBack_;  // a file may be included twice
};

// A view that is declared under the name of its type is that of all passes.
bool servesAll(const Model& model, const ResourceDesc& resource) {
  const ImportType* type = resource.kind == ResourceDesc::Kind::import
                               ? findImportType(model.registry, resource.import.type)
                               : nullptr;
  return type && type->everyPass && type->name == resource.name;
}

// Files that include this one may read what it keeps: it presents nothing, or just that.
bool mayBeReadAbove(const Scope& scope, const ResourceDesc& resource) {
  return scope.parent || !scope.desc->present || scope.desc->present->name == resource.name;
}

void warnOfResource(Model& model, const Scope& scope, const ResourceDesc& resource, const Named& named) {
  const bool input = resource.kind == ResourceDesc::Kind::input;
  if (!named.has(resource) && !servesAll(model, resource)) {
    auto& d = model.diagnostics.warning(
        Code::unusedDeclaration, resource.place,
        fmt::format("the {} '{}' is not used: no pass, list or expression of {} names it",
                    input ? "input" : "resource", resource.name, input ? "this file" : "the graph"));
    d.resource = resource.name;
    d.hint = fmt::format("name '{}' where it is meant, or take it out", resource.name);
  } else if (resource.history.present() && !named.looksBack(resource) && !mayBeReadAbove(scope, resource)) {
    auto& d =
        model.diagnostics.warning(Code::unusedDeclaration, resource.history.place(),
                                  fmt::format("'{}' keeps what it was before, and no pass reads '{}@-1'",
                                              resource.name, resource.name));
    d.resource = resource.name;
    d.hint = fmt::format("read '{}@-1' where that is meant, or leave \"history\" out", resource.name);
  }
}

// The stanza of a pass that is always there, or null: nothing in the files leaves it out.
const PassDesc* findUnconditional(const Model& model, const std::string& declared) {
  for (const Scope& scope : model.scopes) {
    if (!declared.starts_with(scope.prefix)) continue;
    const auto found = scope.passes.find(std::string_view(declared).substr(scope.prefix.size()));
    if (found == scope.passes.end()) continue;
    if (found->second->enabled.present() || !found->second->repeat.empty()) return nullptr;
    for (const Scope* outer = &scope; outer->stanza; outer = outer->parent)
      if (outer->stanza->enabled.present()) return nullptr;
    return found->second;
  }
  return nullptr;
}

// The pass that always writes all of it before anybody reads the list, or null.
const PassDesc* alwaysWrites(const Model& model, std::uint32_t candidate, const Entity& list) {
  for (const WriteRecord& write : model.writes) {
    if (write.entity != candidate || write.pass == kNone || !write.whole || !list.read ||
        write.position >= list.firstRead)
      continue;
    const PassDesc* pass = findUnconditional(model, model.graph.specs[write.pass].declared);
    const auto conditional = [](const SlotDesc& slot) {
      return slot.access != Access::read && slot.ref.condition.present();
    };
    if (pass && std::ranges::none_of(pass->slots, conditional)) return pass;
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
    if (later == refs.end()) return;
    const PassDesc* pass = alwaysWrites(model, list.candidates[i], list);
    if (!pass) continue;
    auto& d = model.diagnostics.warning(
        Code::unusedDeclaration, later->place,
        fmt::format("'{}' never means '{}': '{}' stands before it, and pass '{}' always writes that",
                    list.desc->name, later->text, refs[i].text, pass->name));
    d.resource = list.name;
    d.hint = fmt::format("put '{}' before '{}', or take it out", later->text, refs[i].text);
    return;
  }
}

// A pass alone in its group, whose name is nearly that of another group: it would publish by itself.
void warnOfGroups(Model& model, const Scope& scope) {
  std::map<std::string, int> members;
  for (const PassDesc& pass : scope.desc->passes) {
    const std::string& group = pass.include ? pass.include->group : pass.group;
    if (!group.empty()) members[group] += pass.include ? 2 : 1;  // an include has several passes
  }
  for (const PassDesc& pass : scope.desc->passes) {
    if (pass.include || pass.group.empty() || members[pass.group] > 1 || !isOnTop(scope, pass.place))
      continue;
    std::vector<std::string> others;
    for (const auto& [group, count] : members)
      if (group != pass.group && count > 1) others.push_back(group);
    const std::string near = base::nearestName(pass.group, others);
    if (near.empty()) continue;
    auto& d =
        model.diagnostics.warning(Code::unusedDeclaration, pass.place,
                                  fmt::format("pass '{}' is alone in the group '{}'", pass.name, pass.group));
    d.pass = pass.name;
    d.hint = fmt::format("did you mean '{}'?", near);
  }
}

// Things of the scene whose author put them into lists, of which the graph draws others only.
void warnOfLists(Model& model) {
  if (!model.desc.top.empty()) return;
  std::set<std::string> drawn;
  for (const Scope& scope : model.scopes)
    for (const PassDesc& pass : scope.desc->passes)
      if (!pass.list.empty()) drawn.insert(pass.list);
  if (drawn.empty()) return;  // it shows no things
  for (const ImportSpec& import : model.graph.imports) {
    const ImportType* type = findImportType(model.registry, import.request.type);
    for (std::size_t i = 0; type && i < import.request.arguments.size() && i < type->arguments.size(); ++i)
      if (type->arguments[i].drawList) drawn.insert(import.request.arguments[i].second.symbol);
  }
  for (const Registry::Things& things : model.registry.things) {
    const auto isDrawn = [&](const std::string& list) { return drawn.contains(list); };
    if (std::ranges::any_of(things.lists, isDrawn)) continue;
    auto& d = model.diagnostics.warning(
        Code::unusedDeclaration, model.desc.place,
        fmt::format("the scene has {} in the list{} '{}', which no pass of '{}' draws",
                    things.count == 1 ? "a thing" : fmt::format("{} things", things.count),
                    things.lists.size() == 1 ? "" : "s", fmt::join(things.lists, "', '"), model.desc.name));
    d.hint = fmt::format("add a pass with \"list\": \"{}\", or put them into a list that is drawn: {}",
                         things.lists[0], fmt::join(drawn, ", "));
  }
}

}  // namespace

void warnUnnamed(Model& model) {
  warnOfLists(model);
  const Named named(model);
  std::set<const GraphDesc*> said;  // a file that is included twice says it once
  for (const Scope& scope : model.scopes) {
    if (!said.insert(scope.desc).second) continue;
    warnOfGroups(model, scope);
    for (const ResourceDesc& resource : scope.desc->resources)
      if (isOnTop(scope, resource.place)) warnOfResource(model, scope, resource, named);
  }
  std::set<const ResourceDesc*> judged;
  for (std::size_t i = 0; i < model.entities.size(); ++i) {
    const Entity& entity = model.entities[i];
    if (entity.kind == ResourceDesc::Kind::alternatives && entity.desc && !entity.candidates.empty() &&
        isOnTop(*entity.scope, entity.desc->place) && judged.insert(entity.desc).second)
      warnOfList(model, entity);
  }
}

}  // namespace weft::graph::expansion
