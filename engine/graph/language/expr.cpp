#include "engine/graph/language/expr.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <set>

#include "engine/base/nearest.h"
#include "engine/base/words/foreign_words.h"
#include "engine/graph/language/expr_node.h"

namespace weft::graph {

OpInfo infoOf(ExprOp op) {
  switch (op) {
    case ExprOp::conditional:
      return {"?", 1};
    case ExprOp::logical_or:
      return {"||", 2};
    case ExprOp::logical_and:
      return {"&&", 3};
    case ExprOp::equal:
      return {"==", 4};
    case ExprOp::not_equal:
      return {"!=", 4};
    case ExprOp::less:
      return {"<", 4};
    case ExprOp::less_equal:
      return {"<=", 4};
    case ExprOp::greater:
      return {">", 4};
    case ExprOp::greater_equal:
      return {">=", 4};
    case ExprOp::add:
      return {"+", 5};
    case ExprOp::subtract:
      return {"-", 5};
    case ExprOp::multiply:
      return {"*", 6};
    case ExprOp::divide:
      return {"/", 6};
    case ExprOp::modulo:
      return {"%", 6};
    case ExprOp::negate:
      return {"-", 7};
    case ExprOp::logical_not:
      return {"!", 7};
    case ExprOp::component:
      return {".", 8};
    case ExprOp::minimum:
      return {"min", 0};
    case ExprOp::maximum:
      return {"max", 0};
    case ExprOp::ceil:
      return {"ceil", 0};
    case ExprOp::floor:
      return {"floor", 0};
    case ExprOp::log2ceil:
      return {"log2ceil", 0};
    case ExprOp::pow2ceil:
      return {"pow2ceil", 0};
    case ExprOp::abs:
      return {"abs", 0};
    default:
      return {"", 0};
  }
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

ExprPtr makeNode(ExprOp op, base::Place place, std::vector<ExprPtr> children) {
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

ExprPtr makeConstant(Value value, base::Place place) {
  auto node = std::make_shared<ExprNode>();
  node->value = std::move(value);
  node->place = std::move(place);
  return node;
}

namespace {

std::size_t countVariables(const ExprNode& node) {
  std::size_t count = node.op == ExprOp::variable ? 1 : 0;
  for (const ExprPtr& child : node.children) count += countVariables(*child);
  return count;
}

// `isNew` says whether a name is not in `out` yet.
template <class IsNew>
void collectVariables(const ExprNode& node, std::vector<std::string>& out, const IsNew& isNew) {
  if (node.op == ExprOp::variable && isNew(node.name)) out.push_back(node.name);
  for (const ExprPtr& child : node.children) collectVariables(*child, out, isNew);
}

std::shared_ptr<const std::vector<std::string>> namedBelow(const ExprNode& root) {
  constexpr std::size_t kFew = 16;  // a look at each is faster than a set
  const std::size_t count = root.op == ExprOp::constant ? 0 : countVariables(root);
  if (count == 0) return nullptr;
  auto out = std::make_shared<std::vector<std::string>>();
  if (count <= kFew) {
    out->reserve(count);
    collectVariables(root, *out,
                     [&](const std::string& name) { return std::ranges::find(*out, name) == out->end(); });
    return out;
  }
  std::set<std::string_view> seen;
  collectVariables(root, *out, [&](const std::string& name) { return seen.insert(name).second; });
  return out;
}

}  // namespace

ExprPtr withStart(const ExprPtr& root, const base::Place& start) {
  auto copy = std::make_shared<ExprNode>(*root);
  copy->start = start;
  copy->variables = namedBelow(*root);
  return copy;
}

namespace {

// Canonical text; parentheses only where the grammar needs them. `outer` is the precedence of the
// surroundings.
void print(const ExprNode& node, int outer, std::string& out) {
  const OpInfo info = infoOf(node.op);
  const bool parens = info.precedence > 0 && info.precedence < outer;
  const auto commaSeparated = [&] {
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      if (i > 0) out += ", ";
      print(*node.children[i], 0, out);
    }
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
      out += '[';
      commaSeparated();
      out += ']';
      break;
    case ExprOp::variable:
      out += '$' + node.name;
      break;
    case ExprOp::identifier:
    case ExprOp::builtin:
      out += node.name;
      break;
    case ExprOp::fact:
      out += fmt::format("{}({})", nameOf(node.fact), node.name);
      break;
    case ExprOp::age_key:
      out += fmt::format("age(#{})", node.key);
      break;
    case ExprOp::parameter_key:
      out += fmt::format("$#{}", node.key);
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
        out += '(';
        commaSeparated();
        out += ')';
        break;
      }
      // Comparisons do not chain, so both their sides need a tighter operator.
      print(*node.children[0], info.precedence + (info.precedence == 4 ? 1 : 0), out);
      out += fmt::format(" {} ", info.spelling);
      print(*node.children[1], info.precedence + 1, out);
  }
  if (parens) out += ')';
}

void collectParameters(const ExprNode& node, std::vector<std::uint32_t>& out) {
  if (!node.live) return;
  if (node.op == ExprOp::parameter_key) out.push_back(node.key);
  for (const ExprPtr& child : node.children) collectParameters(*child, out);
}

void collectFacts(const ExprNode& node, std::vector<std::pair<Fact, std::string>>& out) {
  if (node.op == ExprOp::fact) out.emplace_back(node.fact, node.name);
  for (const ExprPtr& child : node.children) collectFacts(*child, out);
}

bool findsWord(const ExprNode& node, std::string_view word) {
  if (node.op == ExprOp::identifier && node.name == word) return true;
  return std::ranges::any_of(node.children, [&](const ExprPtr& child) { return findsWord(*child, word); });
}

}  // namespace

Expr Expr::constant(Value value, base::Place place) {
  Expr expr;
  ExprPtr node = makeConstant(std::move(value), place);
  expr.root_ = withStart(node, place);
  return expr;
}

Expr Expr::parameter(std::uint32_t key, base::Place place) {
  auto node = std::make_shared<ExprNode>();
  node->op = ExprOp::parameter_key;
  node->key = key;
  node->live = node->folded = true;
  node->place = node->start = std::move(place);
  Expr expr;
  expr.root_ = std::move(node);
  return expr;
}

Expr Expr::listOf(std::vector<Expr> items, base::Place place) {
  assert(!items.empty() && items.size() <= 4);
  std::vector<ExprPtr> children;
  children.reserve(items.size());
  bool numbers = true;
  Value value;
  value.type = Value::Type::list;
  for (const Expr& item : items) {
    assert(item.present() && item.root_->height < kMaxExprHeight);
    const bool number = item.root_->op == ExprOp::constant && item.root_->value.type == Value::Type::number;
    numbers = numbers && number;
    if (number) value.v[value.count++] = item.root_->value.v[0];
    children.push_back(item.root_);
  }
  if (numbers) return constant(std::move(value), std::move(place));
  Expr expr;
  expr.root_ = withStart(makeNode(ExprOp::list, place, std::move(children)), place);
  return expr;
}

std::optional<Expr> Expr::parse(std::string_view text, const base::Place& place,
                                base::Diagnostics& diagnostics) {
  const ExprPtr root = parseExprTree(text, place, diagnostics);
  if (!root) return std::nullopt;
  Expr expr;
  expr.root_ = withStart(root, place);
  return expr;
}

bool Expr::dynamic() const {
  return root_ && root_->dynamic;
}

bool Expr::live() const {
  return root_ && root_->live;
}

std::vector<std::uint32_t> Expr::parameterKeys() const {
  std::vector<std::uint32_t> keys;
  if (root_) collectParameters(*root_, keys);
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

std::string Expr::text() const {
  std::string out;
  if (root_) print(*root_, 0, out);
  return out;
}

const base::Place& Expr::place() const {
  static const base::Place none;
  return root_ ? root_->start : none;
}

std::vector<std::string> Expr::variables() const {
  return variablesOf(*this);
}

const std::vector<std::string>& variablesOf(const Expr& expr) {
  static const std::vector<std::string> kNoNames;
  return expr.root() && expr.root()->variables ? *expr.root()->variables : kNoNames;
}

const std::string* onlyVariableOf(const Expr& expr) {
  return expr.root() && expr.root()->op == ExprOp::variable ? &expr.root()->name : nullptr;
}

bool Expr::says(std::string_view word) const {
  return root_ && findsWord(*root_, word);
}

std::vector<std::pair<Fact, std::string>> Expr::facts() const {
  std::vector<std::pair<Fact, std::string>> out;
  if (root_) collectFacts(*root_, out);
  return out;
}

bool Expr::isConstant() const {
  return root_ && root_->op == ExprOp::constant;
}

bool reportBareWords(const ExprNode& comparison, EvalScope& scope, base::Diagnostics& diagnostics) {
  const auto isWord = [&](const ExprNode& node) {
    return node.op == ExprOp::identifier && !scope.index(node.name);
  };
  const ExprNode &left = *comparison.children[0], &right = *comparison.children[1];
  if (!isWord(left) || !isWord(right)) return false;
  const std::vector<std::string> variables = scope.candidates(EvalScope::NameKind::variable);
  const auto isVariable = [&](const ExprNode& node) {
    return std::ranges::find(variables, node.name) != variables.end();
  };
  const ExprNode& meant = !isVariable(left) && isVariable(right) ? right : left;
  base::Diagnostic& d =
      diagnostics.error(base::Code::unknownVariable, meant.place,
                        fmt::format("'{}' and '{}' are bare words: comparing them always gives the same",
                                    left.name, right.name));
  d.expected = "a parameter or an index of \"repeat\" on one side";
  d.hint = hintForWord(scope, Value::text(meant.name));
  return true;
}

std::string hintForWord(EvalScope& scope, const Value& value) {
  if (value.type != Value::Type::symbol) return {};
  const std::vector<std::string> variables = scope.candidates(EvalScope::NameKind::variable);
  if (std::ranges::find(variables, value.symbol) != variables.end())
    return fmt::format("write '${}' for the parameter", value.symbol);
  const std::vector<std::string> builtins = scope.candidates(EvalScope::NameKind::builtin);
  if (const std::string near = base::nearestName(value.symbol, builtins); !near.empty())
    return fmt::format("did you mean '{}'?", near);
  if (std::string foreign = base::hintForForeign(base::Foreign::value, value.symbol); !foreign.empty())
    return foreign;
  const std::string near = base::nearestName(value.symbol, variables);
  if (!near.empty()) return fmt::format("did you mean '${}'?", near);
  const bool bare = std::ranges::all_of(
      value.symbol, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; });
  return bare ? "a bare word is an index of \"repeat\" or 'screen'; a parameter begins with '$'" : "";
}

// ---- folding: what stays while a plan runs becomes a constant, age() and live parameters become keys ----

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
    diagnostics.error(base::Code::badExpression, node->place,
                      "the expression and the \"let\" it uses chain too many operators");
    return nullptr;
  }
  auto copy = std::make_shared<ExprNode>(*node);
  setChildren(*copy, std::move(children));
  if (copy->terms > kMaxFoldedTerms) {
    diagnostics
        .error(base::Code::badExpression, node->place,
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
      auto& d = diagnostics.error(base::Code::unknownVariable, node->place,
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
