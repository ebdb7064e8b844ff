// What the expressions and references of all files name. Declared in names.h.
#include <algorithm>
#include <utility>
#include <vector>

#include "engine/graph/desc_walk.h"
#include "engine/graph/expand/names/names.h"
#include "engine/graph/language/expr_node.h"

namespace weft::graph::expansion {

void Selected::add(const Expr* first, const Expr* last) {
  if (several) return;
  const auto isNumber = [](const Expr* expr) { return expr && expr->isConstant(); };
  several = !isNumber(first) || !isNumber(last) || (first != last && first->text() != last->text()) ||
            (one && one != first && one->text() != first->text());
  one = first;
}

namespace {

class MentionWalk {
 public:
  MentionWalk(Model& model, bool asks)
      : model_(model), asks_(asks), behind_(model.entities.size(), kUnknown) {}

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
    if (asks_) askForOthers(scope);
    for (const PassDesc& pass : desc.passes) {
      if (!pass.list.empty()) mark(find(scope, pass.list, true), false);
      if (pass.include)
        for (const auto& [input, ref] : pass.include->binds) visitRef(ref, onExpr, onRef);
    }
  }

 private:
  static constexpr std::uint32_t kUnknown = kNone - 1;

  // What no expression and no reference asks for.
  void askForOthers(Scope& scope) {
    const GraphDesc& desc = *scope.desc;
    for (const SetDesc& set : desc.sets)
      if (parametersMeant(model_, scope.prefix, set.name).empty())
        model_.unknownVariables.emplace_back(&scope,
                                             std::string_view(set.name).substr(set.name.rfind('.') + 1));
    if (scope.parent)
      for (const ResourceDesc& input : desc.resources)
        if (input.kind == ResourceDesc::Kind::input) askForInput(scope, input);
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
      if (asks_ && found.kind == Variable::Kind::none)
        visitNodes(*expr.root(), [&](const ExprNode& node) {
          if (node.op == ExprOp::variable && node.name == name)
            model_.unknownVariables.emplace_back(&scope, name);
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
        ask(scope, name, 1);
    }
  }

  void add(Scope& scope, const RefDesc& ref) {
    const std::uint32_t named = find(scope, ref.name, ref.import), found = mark(named, ref.history > 0);
    if (named == kNone && !ref.import) ask(scope, ref.name, 1);
    if (found == kNone || ref.import) return;
    Entity& entity = model_.entities[found];
    entity.levels.add(ref.mip);
    entity.layers.add(ref.layer);
    entity.ofArray.add(ref.element ? &*ref.element : nullptr, ref.element ? &*ref.element : nullptr);
  }

  // Nothing has the name.
  void ask(Scope& scope, std::string_view name, int times) {
    if (!asks_) return;
    const Scope& in = scopeOf(scope, name);
    model_.unknown[{&in, std::string(firstPart(name))}] += times;
  }

  // The includer is asked for what it does not bind.
  void askForInput(const Scope& scope, const ResourceDesc& input) {
    Scope& parent = *scope.parent;
    const auto& binds = scope.stanza->include->binds;
    if (std::ranges::any_of(binds, [&](const auto& bind) { return bind.first == input.name; })) return;
    const auto askIn = [&](Scope& in) {
      if (!in.resources.contains(input.name)) ask(in, input.name, input.optional ? 0 : 1);
    };
    for (const auto& [own, ref] : binds)
      if (Scope* const include = includeBound(parent, own, ref)) askIn(*include);
    askIn(parent);
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
  std::uint32_t mark(std::uint32_t index, bool back) {
    while (index != kNone) {
      Entity& entity = model_.entities[index];
      const bool fresh = back && !entity.lookedBackAt;
      entity.named = true;
      entity.lookedBackAt = entity.lookedBackAt || back;
      if (fresh)
        for (const RefDesc& ref : entity.desc->alternatives)
          mark(find(*entity.scope, ref.name, ref.import), true);
      if (entity.kind != ResourceDesc::Kind::input || !entity.scope->parent) return index;
      if (behind_[index] == kUnknown) behind_[index] = findBehind(entity);
      index = behind_[index];
    }
    return kNone;
  }

  // What an include binds to an input, or has of its name.
  std::uint32_t findBehind(const Entity& input) const {
    Scope& parent = *input.scope->parent;
    const std::string& name = input.desc->name;
    const auto& binds = input.scope->stanza->include->binds;
    if (const auto bound = std::ranges::find(binds, name, &std::pair<std::string, RefDesc>::first);
        bound != binds.end() && !includeBound(parent, name, bound->second))
      return find(parent, bound->second.name, bound->second.import);
    for (const auto& [own, ref] : binds)
      if (const Scope* all = includeBound(parent, own, ref))
        if (const std::uint32_t found = find(*all, name, false); found != kNone) return found;
    return find(parent, name, false);
  }

  Model& model_;
  const bool asks_;                    // notes what nothing has
  std::vector<std::uint32_t> behind_;  // per entity: of an input
};

}  // namespace

void noteMentions(Model& model, bool unknown) {
  if (unknown && std::exchange(model.unknownNoted, true)) return;
  MentionWalk walk(model, unknown);
  for (Scope& scope : model.scopes) walk.add(scope);
}

}  // namespace weft::graph::expansion
