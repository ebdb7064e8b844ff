// What expressions depend on through lets: age(), live parameters, and parameters that structure depends on. Walks without
// recursion, because lets may stand in long rows. Declared in scope.h.
#include <algorithm>
#include <functional>
#include <set>
#include <utility>

#include "engine/graph/expand/names/names.h"
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
