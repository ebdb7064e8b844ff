#include "engine/graph/language/expr.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <set>

#include "engine/graph/language/expr_node.h"
#include "engine/text/chars.h"
#include "engine/text/nearest.h"
#include "engine/text/words/foreign_words.h"

namespace weft::graph {

namespace {

// In the order of ExprOp, from `component` on.
constexpr OpInfo kOps[] = {{".", 8},
                           {"-", 7},
                           {"!", 7},
                           {"+", 5},
                           {"-", 5},
                           {"*", 6},
                           {"/", 6},
                           {"%", 6},
                           {"==", 4},
                           {"!=", 4},
                           {"<", 4},
                           {"<=", 4},
                           {">", 4},
                           {">=", 4},
                           {"&&", 3},
                           {"||", 2},
                           {"?", 1},
                           {"min", 0, 2, 8},
                           {"max", 0, 2, 8},
                           {"ceil", 0, 1, 1},
                           {"floor", 0, 1, 1},
                           {"log2ceil", 0, 1, 1},
                           {"pow2ceil", 0, 1, 1},
                           {"abs", 0, 1, 1}};
constexpr auto kFirstOp = static_cast<std::size_t>(ExprOp::component);
static_assert(std::size(kOps) == static_cast<std::size_t>(ExprOp::abs) - kFirstOp + 1);

}  // namespace

OpInfo infoOf(ExprOp op) {
  const auto at = static_cast<std::size_t>(op);
  return at < kFirstOp ? OpInfo{"", 0} : kOps[at - kFirstOp];
}

ExprOp findOp(std::string_view spelling, ExprOp first, ExprOp last) {
  for (auto op = first; op <= last; op = static_cast<ExprOp>(static_cast<int>(op) + 1))
    if (infoOf(op).spelling == spelling) return op;
  return ExprOp::constant;
}

const char* nameOf(Fact fact) {
  static constexpr const char* kNames[] = {"size", "mips", "count", "has", "age"};
  return kNames[static_cast<int>(fact)];
}

int heightOver(const std::vector<ExprPtr>& children) {
  int height = 0;
  for (const ExprPtr& child : children) height = std::max<int>(height, child->height);
  return height + 1;
}

std::uint32_t termsOver(const std::vector<ExprPtr>& children) {
  std::uint64_t terms = 1;
  for (const ExprPtr& child : children) terms += child->terms;
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(terms, ~std::uint32_t{0}));
}

ExprPtr makeNode(ExprOp op, text::Place place, std::vector<ExprPtr> children) {
  auto node = std::make_shared<ExprNode>();
  node->op = op;
  node->place = std::move(place);
  setChildren(*node, std::move(children));
  return node;
}

void setChildren(ExprNode& node, std::vector<ExprPtr> children) {
  const int height = heightOver(children);
  assert(height <= kMaxExprHeight + 1);
  node.height = static_cast<std::uint8_t>(height);
  node.dynamic = node.live = false;
  for (const ExprPtr& child : children) {
    node.dynamic = node.dynamic || child->dynamic;
    node.live = node.live || child->live;
  }
  node.terms = termsOver(children);
  node.children = std::move(children);
}

ExprPtr makeConstant(Value value, text::Place place) {
  auto node = std::make_shared<ExprNode>();
  node->value = std::move(value);
  node->place = std::move(place);
  return node;
}

namespace {

// Calls f for the node and everything below it.
template <class F>
void visitNodes(const ExprNode& node, const F& f) {
  f(node);
  for (const ExprPtr& child : node.children) visitNodes(*child, f);
}

// Canonical text; parentheses only where the grammar needs them. `outer` is the precedence of the
// surroundings.
void print(const ExprNode& node, int outer, std::string& out) {
  const OpInfo info = infoOf(node.op);
  const bool parens = info.precedence > 0 && info.precedence < outer;
  const auto list = [&](const char* open, char close) {
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      out += i > 0 ? ", " : open;
      print(*node.children[i], 0, out);
    }
    out += close;
  };
  if (parens) out += '(';
  switch (node.op) {
    case ExprOp::constant: {
      // A negative constant binds like a unary minus.
      const bool wrap = node.value.type == Value::Type::number && node.value.v[0] < 0 && outer > 7;
      out += wrap ? "(" + toText(node.value) + ")" : toText(node.value);
      break;
    }
    case ExprOp::list:
      list("[", ']');
      break;
    case ExprOp::variable:
    case ExprOp::identifier:
    case ExprOp::builtin:
      out += (node.op == ExprOp::variable ? "$" : "") + node.name;
      break;
    case ExprOp::fact:
      out += fmt::format("{}({})", nameOf(node.fact), node.name);
      break;
    case ExprOp::age_key:
    case ExprOp::parameter_key:
      out += fmt::format("{}{}{}", node.op == ExprOp::age_key ? "age(#" : "$#", node.key,
                         node.op == ExprOp::age_key ? ")" : "");
      break;
    case ExprOp::component:
      print(*node.children[0], info.precedence, out);
      out += '.';
      out += "xyzw"[node.key];
      break;
    case ExprOp::negate:
    case ExprOp::logical_not:
      out += info.spelling;
      print(*node.children[0], info.precedence + 1, out);
      break;
    case ExprOp::conditional:
      print(*node.children[0], 2, out);
      out += " ? ";
      print(*node.children[1], 0, out);
      out += " : ";
      print(*node.children[2], 1, out);
      break;
    default:
      if (info.precedence == 0) {
        out += info.spelling;
        list("(", ')');
        break;
      }
      // Comparisons do not chain, so both their sides need a tighter operator.
      print(*node.children[0], info.precedence + (info.precedence == 4 ? 1 : 0), out);
      out += fmt::format(" {} ", info.spelling);
      print(*node.children[1], info.precedence + 1, out);
  }
  if (parens) out += ')';
}

}  // namespace

Expr::Expr(ExprPtr root, text::Place start) : root_(std::move(root)), start_(std::move(start)) {
  std::vector<std::string> names;
  std::set<std::string_view> seen;
  visitNodes(*root_, [&](const ExprNode& node) {
    if (node.op == ExprOp::variable && seen.insert(node.name).second) names.push_back(node.name);
  });
  if (!names.empty()) variables_ = std::make_shared<const std::vector<std::string>>(std::move(names));
}

Expr Expr::constant(Value value, text::Place place) {
  return {makeConstant(std::move(value), place), place};
}

Expr Expr::parameter(std::uint32_t key, text::Place place) {
  auto node = std::make_shared<ExprNode>();
  node->op = ExprOp::parameter_key;
  node->key = key;
  node->live = node->folded = true;
  node->place = place;
  return {std::move(node), std::move(place)};
}

Expr Expr::listOf(std::vector<Expr> items, text::Place place) {
  assert(!items.empty() && items.size() <= 4);
  std::vector<ExprPtr> children;
  Value value;
  value.type = Value::Type::list;
  for (const Expr& item : items) {
    assert(item.present() && item.root_->height < kMaxExprHeight);
    if (item.isConstant() && item.root_->value.type == Value::Type::number)
      value.v[value.count++] = item.root_->value.v[0];
    children.push_back(item.root_);
  }
  if (value.count == items.size()) return constant(std::move(value), std::move(place));
  return {makeNode(ExprOp::list, place, std::move(children)), place};
}

std::optional<Expr> Expr::parse(std::string_view text, const text::Place& place,
                                text::Diagnostics& diagnostics) {
  ExprPtr root = parseExprTree(text, place, diagnostics);
  if (!root) return std::nullopt;
  return Expr(std::move(root), place);
}

bool Expr::dynamic() const {
  return root_ && root_->dynamic;
}

bool Expr::live() const {
  return root_ && root_->live;
}

std::vector<std::uint32_t> Expr::parameterKeys() const {
  std::set<std::uint32_t> keys;
  if (live())
    visitNodes(*root_, [&](const ExprNode& node) {
      if (node.op == ExprOp::parameter_key) keys.insert(node.key);
    });
  return {keys.begin(), keys.end()};
}

std::string Expr::text() const {
  std::string out;
  if (root_) print(*root_, 0, out);
  return out;
}

const std::vector<std::string>& Expr::variables() const {
  static const std::vector<std::string> kNoNames;
  return variables_ ? *variables_ : kNoNames;
}

const std::string* onlyVariableOf(const Expr& expr) {
  return expr.root() && expr.root()->op == ExprOp::variable ? &expr.root()->name : nullptr;
}

bool Expr::says(std::string_view word) const {
  bool found = false;
  if (root_)
    visitNodes(*root_, [&](const ExprNode& node) {
      found = found || (node.op == ExprOp::identifier && node.name == word);
    });
  return found;
}

std::vector<std::pair<Fact, std::string>> Expr::facts() const {
  std::vector<std::pair<Fact, std::string>> out;
  if (root_)
    visitNodes(*root_, [&](const ExprNode& node) {
      if (node.op == ExprOp::fact) out.emplace_back(node.fact, node.name);
    });
  return out;
}

bool Expr::isConstant() const {
  return root_ && root_->op == ExprOp::constant;
}

std::string hintForWord(EvalScope& scope, const Value& value) {
  if (value.type != Value::Type::symbol) return {};
  const std::vector<std::string> variables = scope.candidates(EvalScope::NameKind::variable);
  if (std::ranges::find(variables, value.symbol) != variables.end())
    return fmt::format("write '${}' for the parameter", value.symbol);
  const std::vector<std::string> builtins = scope.candidates(EvalScope::NameKind::builtin);
  if (const std::string near = text::nearestName(value.symbol, builtins); !near.empty())
    return fmt::format("did you mean '{}'?", near);
  if (std::string foreign = text::hintForForeign(text::Foreign::value, value.symbol); !foreign.empty())
    return foreign;
  const std::string near = text::nearestName(value.symbol, variables);
  if (!near.empty()) return fmt::format("did you mean '${}'?", near);
  return std::ranges::all_of(value.symbol, text::isIdentChar)
             ? "a bare word is an index of \"repeat\" or 'screen'; a parameter begins with '$'"
             : "";
}

// ---- folding: what stays while a plan runs becomes a constant, age() and live parameters become keys ----

namespace {

bool isConstantNumeric(const ExprPtr& node) {
  return node->op == ExprOp::constant && node->value.isNumeric();
}

// Whether a node, or something below it, is known only while a plan runs.
bool changesLater(const ExprNode& root, EvalScope& scope) {
  bool changes = root.dynamic || root.live;
  visitNodes(root, [&](const ExprNode& node) {
    changes = changes ||
              (node.op == ExprOp::variable && (scope.folded(node.name) || scope.parameterKey(node.name)));
  });
  return changes;
}

// Null after an error.
ExprPtr foldNode(const ExprPtr& node, EvalScope& scope, text::Diagnostics& diagnostics) {
  if (node->folded) return node;
  if (node->op == ExprOp::variable) {
    if (const Expr* folded = scope.folded(node->name))
      return folded->present() ? folded->root()->shared_from_this()
                               : nullptr;  // reported where it was folded
    if (const std::optional<std::uint32_t> key = scope.parameterKey(node->name))
      return Expr::parameter(*key, node->place).root()->shared_from_this();
  }
  if (!changesLater(*node, scope)) {
    Value value = evaluateNode(*node, scope, diagnostics);
    return value.type == Value::Type::none ? nullptr : makeConstant(std::move(value), node->place);
  }
  if (node->op == ExprOp::fact) {
    const std::optional<std::uint32_t> key = scope.ageKey(node->name);
    if (!key) {
      if (scope.fact(Fact::age, node->name, node->place)) return nullptr;  // reported
      auto& d = diagnostics.error(text::Code::unknownVariable, node->place,
                                  fmt::format("age() of unknown resource '{}'", node->name));
      d.hint = text::nearestHint(node->name, scope.candidates(EvalScope::NameKind::fact_argument));
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
  if (heightOver(children) > kMaxExprHeight || termsOver(children) > kMaxFoldedTerms) {
    diagnostics
        .error(
            text::Code::badExpression, node->place,
            fmt::format("the expression and the \"let\" it uses have more than {} operators and operands, or "
                        "too many in a row",
                        kMaxFoldedTerms))
        .hint = "age() changes in every frame, and all of it is evaluated then: use it fewer times";
    return nullptr;
  }
  auto folded = std::make_shared<ExprNode>(*node);
  setChildren(*folded, std::move(children));
  folded->folded = true;
  if (folded->dynamic || folded->live) return folded;
  Value value = evaluateNode(*folded, scope, diagnostics);
  return value.type == Value::Type::none ? nullptr : makeConstant(std::move(value), node->place);
}

}  // namespace

Expr Expr::fold(EvalScope& scope, text::Diagnostics& diagnostics) const {
  const ExprPtr folded = root_ ? foldNode(root_, scope, diagnostics) : nullptr;
  if (!folded) return {};
  if (folded->dynamic && !folded->live) {  // else the caller knows the values of the parameters
    const AgeFunction trialAge = [](std::uint32_t) { return kTrialAge; };
    if (evaluateNode(*folded, trialAge, {}, &diagnostics).type == Value::Type::none) return {};
  }
  return {folded, start_};
}

}  // namespace weft::graph
