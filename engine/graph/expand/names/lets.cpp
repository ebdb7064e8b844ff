// What expressions depend on through lets: age(), live parameters, and parameters that structure depends on. Walks without
// recursion, because lets may stand in long rows.
#include <set>
#include <utility>

#include "engine/graph/expand/names/scope.h"
#include "engine/graph/language/expr_node.h"

namespace weft::graph::expansion {

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

bool countsElements(Model& model, Scope& scope, const Expr& expr) {
  std::vector<std::pair<Scope*, const Expr*>> open{{&scope, &expr}};
  std::set<std::uint32_t> seen;  // lets
  while (!open.empty()) {
    const auto [from, each] = open.back();
    open.pop_back();
    if (!each->present() || each->isConstant()) continue;
    for (const auto& [fact, name] : each->facts())
      if (fact == Fact::count || fact == Fact::has) return true;
    for (const std::string& name : variablesOf(*each))
      if (const Variable variable = findVariable(model, *from, name);
          variable.kind == Variable::Kind::let && seen.insert(variable.index).second)
        open.emplace_back(model.lets[variable.index].scope, &model.lets[variable.index].desc->expr);
  }
  return false;
}

}  // namespace weft::graph::expansion
