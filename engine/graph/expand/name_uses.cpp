// Declared in expand.h.
#include <algorithm>
#include <map>
#include <tuple>

#include "engine/graph/desc_walk.h"
#include "engine/graph/expand/expand.h"
#include "engine/graph/expand/names/names.h"

namespace weft::graph {

namespace expansion {

namespace {

using UseOf = NameUse::Kind;

using NamePlace = std::tuple<std::string_view, std::uint32_t, std::uint32_t, bool>;
NamePlace orderOf(const Place& place, bool key = false) {
  return {place.file ? std::string_view(*place.file) : "", place.line, place.column, key};
}

Place insideOf(const Place& quote) {
  return quote.after(1);
}

class NameFinder {
 public:
  explicit NameFinder(Model& model) : model_(model) {}

  std::vector<NameUse> run() {
    for (Scope& scope : model_.scopes) addFile(scope);
    // What an overlay writes anew is declared below it all the same.
    std::map<NamePlace, Place> below;
    for (const NamedDesc& named : model_.desc.named)
      below[orderOf(insideOf(named.place))] = insideOf(named.declared);
    std::vector<NameUse> all;
    for (auto& [at, use] : uses_) {
      if (const auto own = below.find(orderOf(use.declared)); own != below.end()) use.declared = own->second;
      all.push_back(std::move(use));
    }
    return all;
  }

 private:
  void add(UseOf kind, std::string_view name, std::string full, const Place& place, Place declared) {
    if (place.file)
      uses_.try_emplace(orderOf(place, key_),
                        NameUse{kind, std::string(name), std::move(full), place, key_, declared});
  }
  template <class Thing>
  void declare(UseOf kind, const std::string& prefix, const Thing& thing) {
    add(kind, thing.name, prefix + thing.name, insideOf(thing.place), insideOf(thing.place));
  }

  static Place placeOf(const PassDesc& pass) {
    const bool path = pass.include && pass.namePlace == pass.include->filePlace;
    return path ? pass.namePlace : insideOf(pass.namePlace);
  }

  void addFile(Scope& scope) {
    const GraphDesc& desc = *scope.desc;
    for (const NamedDesc& named : desc.named) addNamed(scope, named);
    for (const ParameterDesc& each : desc.parameters) declare(UseOf::variable, scope.prefix, each);
    for (const NamedExpr& each : desc.lets) declare(UseOf::variable, scope.prefix, each);
    for (const ResourceDesc& each : desc.resources) declare(UseOf::resource, scope.prefix, each);
    for (const auto& [name, place] : desc.slotSets)
      add(UseOf::set, name, scope.prefix + name, insideOf(place), insideOf(place));
    for (const SetDesc& set : desc.sets) addVariable(scope, set.name, insideOf(set.place));
    for (const ResourceDesc& each : desc.resources)
      for (const NamedExpr& argument : each.import.arguments)
        if (argument.expr.present() && argument.expr.root()->op == ExprOp::identifier)
          addWord(scope, argument.expr.root()->name, argument.expr.root()->place);
    for (const PassDesc& pass : desc.passes) addPass(scope, pass);
    const auto onExpr = [&](const Expr& expr) {
      if (expr.present()) addNode(scope, *expr.root());
    };
    visitMentions(desc, onExpr, [&](const RefDesc& ref) { addRef(scope, ref); });
  }

  void addPass(Scope& scope, const PassDesc& pass) {
    addTo(scope, pass, placeOf(pass));
    addWord(scope, pass.list, insideOf(pass.listPlace));
    for (const PassParameterDesc& each : pass.parameters)
      if (each.declared) declare(UseOf::variable, scope.prefix + pass.name + ".", *each.declared);
    for (const UsedSet& set : pass.uses)
      add(UseOf::set, set.name, scope.prefix + set.name, insideOf(set.place), insideOf(set.declared));
    const auto child = pass.include ? scope.includes.find(pass.name) : scope.includes.end();
    if (child == scope.includes.end()) return;
    for (std::size_t i = 0; i < pass.include->binds.size(); ++i) {
      const auto& [input, ref] = pass.include->binds[i];
      addRef(scope, ref);
      key_ = ref.place == insideOf(pass.include->bindPlaces[i]);
      addResource(*child->second, input, insideOf(pass.include->bindPlaces[i]), false);
      key_ = false;
    }
  }

  // A pass or an include of the file of `scope`.
  void addTo(const Scope& scope, const PassDesc& pass, const Place& place) {
    add(UseOf::pass, pass.name, scope.prefix + pass.name, place, placeOf(pass));
  }

  // The prefixes of a dotted name. Returns the scope of what is left of the name.
  Scope& addPrefixes(Scope& scope, std::string_view& name, Place& place) {
    Scope* in = &scope;
    for (std::size_t dot = name.find('.'); dot != std::string_view::npos; dot = name.find('.')) {
      const auto child = in->includes.find(name.substr(0, dot));
      if (child == in->includes.end()) break;
      addTo(*in, *child->second->stanza, place);
      in = child->second;
      name.remove_prefix(dot + 1);
      place = place.after(dot + 1);
    }
    return *in;
  }

  void addRef(Scope& scope, const RefDesc& ref) {
    const std::size_t at = ref.text.find(ref.name);
    if (at != std::string::npos) addResource(scope, ref.name, ref.place.after(at), ref.import);
  }

  // A word that may name an import which a file declares.
  void addWord(Scope& scope, std::string_view name, const Place& place) {
    const std::uint32_t found = name.empty() ? kNone : findEntity(model_, scope, name, true);
    if (found != kNone && model_.entities[found].desc) addResource(scope, name, place, true);
  }

  void addResource(Scope& scope, std::string_view name, Place place, bool import) {
    if (import && name.find('.') == std::string_view::npos) {
      const std::uint32_t found = findEntity(model_, scope, name, true);
      if (found == kNone) return;
      const Entity& entity = model_.entities[found];
      return add(UseOf::resource, name, entity.name, place,
                 entity.desc ? insideOf(entity.desc->place) : Place{});
    }
    Scope& in = addPrefixes(scope, name, place);
    if (const auto own = in.resources.find(name); own != in.resources.end()) {
      const Entity& entity = model_.entities[own->second];
      add(UseOf::resource, name, entity.name, place, insideOf(entity.desc->place));
    } else if (const auto pass = in.passes.find(name); pass != in.passes.end()) {
      addTo(in, *pass->second, place);  // of has(pass)
    } else if (const auto include = in.includes.find(name); include != in.includes.end()) {
      addTo(in, *include->second->stanza, place);  // of "bind"
    }
  }

  // The nearest file that knows the first part has the prefixes.
  void addVariable(Scope& scope, std::string_view name, const Place& place) {
    const Variable found = findVariable(model_, scope, name);
    if (found.kind != Variable::Kind::parameter && found.kind != Variable::Kind::let) return;
    const bool parameter = found.kind == Variable::Kind::parameter;
    const std::string& full = parameter ? model_.parameters[found.index].path : model_.lets[found.index].path;
    const Place& declared =
        parameter ? model_.parameters[found.index].desc->place : model_.lets[found.index].desc->place;
    const std::size_t leaf = name.rfind('.') + 1;
    for (Scope* from = &scope; leaf > 0 && from; from = from->parent) {
      std::string_view rest = name;
      Place at = place;
      if (!from->variables.contains(name)) continue;
      const Scope& in = addPrefixes(*from, rest, at);
      if (const std::size_t dot = rest.find('.'); dot != std::string_view::npos)
        if (const auto pass = in.passes.find(rest.substr(0, dot)); pass != in.passes.end())
          addTo(in, *pass->second, at);
      break;
    }
    add(UseOf::variable, name.substr(leaf), full, place.after(leaf), insideOf(declared));
  }

  void addNode(Scope& scope, const ExprNode& node) {
    if (node.op == ExprOp::variable) {
      addVariable(scope, node.name, node.place.after(1));
    } else if (node.op == ExprOp::fact) {
      const bool import = node.name.starts_with('@');
      addResource(scope, std::string_view(node.name).substr(import ? 1 : 0), node.place.after(node.key),
                  import);
    }
    for (const ExprPtr& child : node.children) addNode(scope, *child);
  }

  void addNamed(Scope& scope, const NamedDesc& named) {
    std::string_view name = named.name;
    Place place = insideOf(named.place);
    const Scope& in = addPrefixes(scope, name, place);
    const bool set = std::ranges::any_of(in.desc->slotSets, [&](const auto& each) {
      return each.first == name && each.second == named.declared;
    });
    const UseOf kind = set                           ? UseOf::set
                       : in.resources.contains(name) ? UseOf::resource
                       : in.variables.contains(name) ? UseOf::variable
                                                     : UseOf::pass;
    add(kind, name, in.prefix + std::string(name), place, insideOf(named.declared));
  }

  Model& model_;
  std::map<NamePlace, NameUse> uses_;
  bool key_ = false;  // of the next use
};

}  // namespace

}  // namespace expansion

std::vector<NameUse> findNameUses(const GraphDesc& desc, const Registry& registry) {
  const Settings settings;
  text::Diagnostics ignored;
  expansion::Model model{desc, registry, settings, ignored};
  expansion::buildScopes(model);
  return model.stopped ? std::vector<NameUse>() : expansion::NameFinder(model).run();
}

}  // namespace weft::graph
