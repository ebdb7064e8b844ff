// What the expressions and references of all files name. Declared in names.h.
#include <utility>
#include <vector>

#include "engine/graph/desc_walk.h"
#include "engine/graph/expand/names/names.h"

namespace weft::graph::expansion {

namespace {

class MentionWalk {
 public:
  explicit MentionWalk(Model& model) : model_(model), behind_(model.entities.size(), kUnknown) {}

  void add(Scope& scope) {
    const GraphDesc& desc = *scope.desc;
    const auto onExpr = [&](const Expr& expr) { add(scope, expr, true); };
    const auto onValue = [&](const Expr& expr) { add(scope, expr, false); };
    const auto onRef = [&](const RefDesc& ref) { add(scope, ref); };
    visitMentions(desc, onExpr, onRef, onValue);
    for (const ResourceDesc& resource : desc.resources)
      for (const NamedExpr& argument : resource.import.arguments)
        if (argument.expr.present() && argument.expr.root()->op == ExprOp::identifier)
          mark(find(scope, argument.expr.root()->name, true), false);
    askForOthers(scope);
    for (const PassDesc& pass : desc.passes) {
      if (!pass.list.empty()) mark(find(scope, pass.list, true), false);
      if (pass.include)
        for (const auto& [input, ref] : pass.include->binds) visitRef(ref, onExpr, onRef);
    }
  }

 private:
  static constexpr std::uint32_t kUnknown = kNone - 1;
  using Asked = Model::Asked::Kind;

  // What no expression and no reference asks for.
  void askForOthers(Scope& scope) {
    const GraphDesc& desc = *scope.desc;
    for (const SetDesc& set : desc.sets)
      if (parametersMeant(model_, scope.prefix, set.name).empty())
        ask(Asked::variable, scope, std::string_view(set.name).substr(set.name.rfind('.') + 1));
    for (const ResourceDesc& input : desc.resources)
      if (scope.parent && input.kind == ResourceDesc::Kind::input && !input.optional)
        if (const std::uint32_t own = find(scope, input.name, false); behind(own) == kNone)
          if (const Behind from = behindInput(model_, model_.entities[own]); !from.bind) {
            ask(Asked::resource, *from.scope, input.name);
            for (const auto& [bound, ref] : scope.stanza->include->binds)
              if (Scope* const include = includeBound(*scope.parent, bound, ref))
                ask(Asked::resource, *include, input.name);
          }
  }

  void add(Scope& scope, const Expr& expr, bool structural) {
    if (!expr.present() || expr.isConstant()) return;
    for (const std::string& name : expr.variables()) {
      const Variable found = findVariable(model_, scope, name);
      if (found.kind == Variable::Kind::let) {
        Let& let = model_.lets[found.index];
        let.named = true;
        if (structural && !std::exchange(let.structural, true))
          markStructural(model_, *let.scope, let.desc->expr);
      }
      if (found.kind == Variable::Kind::parameter) {
        Parameter& parameter = model_.parameters[found.index];
        parameter.named = true;
        parameter.structural = parameter.structural || structural;
      }
      if (found.kind == Variable::Kind::none)
        visitNodes(*expr.root(), [&](const ExprNode& node) {
          if (node.op == ExprOp::variable && node.name == name)
            ask(name.find('.') == std::string::npos ? Asked::variable : Asked::pass, scope, name);
        });
      if (found.kind == Variable::Kind::ambiguous)
        for (const std::uint32_t each : parametersMeant(model_, scope.prefix, name))
          model_.parameters[each].named = true;
    }
    for (const auto& [fact, name] : expr.facts()) {
      const std::uint32_t found = find(scope, name, false);
      if (found != kNone)
        mark(found, false);
      else if (!name.starts_with('@') && (fact != Fact::has || !findAskedPass(scope, name).first))
        ask(Asked::resource, scope, name);
    }
  }

  void add(Scope& scope, const RefDesc& ref) {
    const std::uint32_t named = find(scope, ref.name, ref.import);
    mark(named, ref.history > 0);
    if (named == kNone && !ref.import) ask(Asked::resource, scope, ref.name);
  }

  // Nothing has the name.
  void ask(Asked kind, Scope& scope, std::string_view name) {
    Scope& in = kind == Asked::resource ? scopeOf(scope, name) : scope;
    const bool unread =
        kind == Asked::resource ? isUnread(in, firstPart(name)) : model_.toInclude || isUnread(in, name);
    if (!unread) model_.asked.push_back({kind, &in, firstPart(name)});
  }

  // What a name means as it is written: an input is itself. kNone for what no file declares.
  std::uint32_t find(Scope& scope, std::string_view name, bool import) const {
    if (name.starts_with('@')) return find(scope, name.substr(1), true);
    import = import && name.find('.') == std::string_view::npos;
    for (const Scope* at = &scopeOf(scope, name); at; at = import ? at->parent : nullptr)
      if (const auto found = at->resources.find(name); found != at->resources.end())
        if (!import || model_.entities[found->second].kind == ResourceDesc::Kind::import)
          return found->second;
    return kNone;
  }

  // An input, and all that is bound to it; of what is looked back at also what the list may mean.
  void mark(std::uint32_t index, bool back) {
    while (index != kNone) {
      Entity& entity = model_.entities[index];
      const bool fresh = back && !entity.lookedBackAt;
      entity.named = true;
      entity.lookedBackAt = entity.lookedBackAt || back;
      if (fresh)
        for (const RefDesc& ref : entity.desc->alternatives)
          mark(find(*entity.scope, ref.name, ref.import), true);
      if (entity.kind != ResourceDesc::Kind::input || !entity.scope->parent) return;
      index = behind(index);
    }
  }

  std::uint32_t behind(std::uint32_t input) {
    std::uint32_t& known = behind_[input];
    if (known != kUnknown) return known;
    const Behind from = behindInput(model_, model_.entities[input]);
    return known = find(*from.scope, from.name, from.import);
  }

  Model& model_;
  std::vector<std::uint32_t> behind_;  // per entity: of an input
};

}  // namespace

void noteMentions(Model& model) {
  MentionWalk walk(model);
  for (Scope& scope : model.scopes) walk.add(scope);
}

}  // namespace weft::graph::expansion
