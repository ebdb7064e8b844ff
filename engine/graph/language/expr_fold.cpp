// Folding: everything that stays while a plan runs becomes a constant, age() and live parameters become keys.
#include <fmt/format.h>

#include <algorithm>

#include "engine/base/nearest.h"
#include "engine/graph/language/expr_node.h"

namespace weft::graph {

using base::Code;

namespace {

bool isConstantNumeric(const ExprPtr& node) {
  return node->op == ExprOp::constant && node->value.isNumeric();
}

// `node` with every variable that the scope answers with a folded tree replaced by that tree; null after an
// error.
ExprPtr substitute(const ExprPtr& node, EvalScope& scope, base::Diagnostics& diagnostics) {
  if (node->op == ExprOp::variable) {
    const Expr* folded = scope.folded(node->name);
    if (folded && !folded->present()) return nullptr;  // reported where it was folded
    if (folded) return folded->root()->shared_from_this();
    const std::optional<std::uint32_t> key = scope.parameterKey(node->name);
    return key ? Expr::parameter(*key, node->place).root()->shared_from_this() : node;
  }
  bool changed = false;
  std::vector<ExprPtr> children;
  for (const ExprPtr& child : node->children) {
    ExprPtr other = substitute(child, scope, diagnostics);
    if (!other) return nullptr;
    changed = changed || other != child;
    children.push_back(std::move(other));
  }
  if (!changed) return node;
  if (heightOver(children) > kMaxExprHeight) {
    diagnostics.error(Code::badExpression, node->place,
                      "the expression and the \"let\" it uses chain too many operators");
    return nullptr;
  }
  auto copy = std::make_shared<ExprNode>(*node);
  setChildren(*copy, std::move(children));
  if (copy->terms > kMaxFoldedTerms) {
    diagnostics
        .error(Code::badExpression, node->place,
               fmt::format("the expression and the \"let\" it uses have more than {} operators and operands",
                           kMaxFoldedTerms))
        .hint = "age() changes in every frame, and all of it is evaluated then: use it fewer times";
    return nullptr;
  }
  return copy;
}

// Null after an error.
ExprPtr foldNode(const ExprPtr& node, EvalScope& scope, base::Diagnostics& diagnostics) {
  if (node->folded) return node;
  if (!node->dynamic && !node->live) {
    Value value = evaluateNode(*node, scope, diagnostics);
    return value.type == Value::Type::none ? nullptr : makeConstant(std::move(value), node->place);
  }
  if (node->op == ExprOp::fact) {
    const std::optional<std::uint32_t> key = scope.ageKey(node->name);
    if (!key) {
      if (scope.fact(Fact::age, node->name, node->place)) return nullptr;  // reported
      auto& d = diagnostics.error(Code::unknownVariable, node->place,
                                  fmt::format("age() of unknown resource '{}'", node->name));
      d.hint = base::nearestHint(node->name, scope.candidates(EvalScope::NameKind::fact_argument));
      return nullptr;
    }
    auto folded = std::make_shared<ExprNode>(*node);
    folded->op = ExprOp::age_key;
    folded->key = *key;
    folded->folded = true;
    return folded;
  }
  std::vector<ExprPtr> children;
  for (std::size_t i = 0; i < node->children.size(); ++i) {
    ExprPtr child = foldNode(node->children[i], scope, diagnostics);
    if (!child) return nullptr;
    // A first operand that is known decides which others are looked at at all.
    if (i == 0 && isConstantNumeric(child)) {
      const bool truth = child->value.truth();
      if (node->op == ExprOp::conditional) return foldNode(node->children[truth ? 1 : 2], scope, diagnostics);
      if (node->op == ExprOp::logical_or && truth) return makeConstant(Value::boolean(true), node->place);
      if (node->op == ExprOp::logical_and && !truth) return makeConstant(Value::boolean(false), node->place);
    }
    children.push_back(std::move(child));
  }
  auto folded = std::make_shared<ExprNode>(*node);
  setChildren(*folded, std::move(children));
  folded->folded = true;
  if (folded->dynamic || folded->live) return folded;
  Value value = evaluateNode(*folded, scope, diagnostics);
  return value.type == Value::Type::none ? nullptr : makeConstant(std::move(value), node->place);
}

}  // namespace

Expr Expr::fold(EvalScope& scope, base::Diagnostics& diagnostics) const {
  Expr out;
  const ExprPtr whole = root_ ? substitute(root_, scope, diagnostics) : nullptr;
  const ExprPtr folded = whole ? foldNode(whole, scope, diagnostics) : nullptr;
  if (!folded) return out;
  if (folded->dynamic && !folded->live) {  // else the caller knows the values of the parameters
    const AgeFunction trialAge = [](std::uint32_t) { return kTrialAge; };
    if (evaluateNode(*folded, trialAge, {}, &diagnostics).type == Value::Type::none) return out;
  }
  out.root_ = withStart(folded, root_->start);
  return out;
}

}  // namespace weft::graph
