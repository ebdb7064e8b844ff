#include "engine/graph/language/expr.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <set>

#include "engine/graph/language/expr_node.h"
#include "engine/text/nearest.h"
#include "engine/text/words/words.h"
#include "graph_sentences.h"

namespace weft::graph {

using text::Code;

namespace {

// Smallest k >= 0 with 2^k >= x, for x > 0. Exact.
double log2ceil(double x) {
  if (x <= 1) return 0;
  if (std::isinf(x)) return x;
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);  // x = mantissa * 2^exponent, mantissa in [0.5, 1)
  return mantissa == 0.5 ? exponent - 1 : exponent;
}

// In the order of ExprOp, from `component` on.
constexpr OpInfo kOps[] = {
    {".", 8},
    {"-", 7, 0, 0, [](double a, double) { return -a; }},
    {"!", 7},
    {"+", 5, 0, 0, [](double a, double b) { return a + b; }},
    {"-", 5, 0, 0, [](double a, double b) { return a - b; }},
    {"*", 6, 0, 0, [](double a, double b) { return a * b; }},
    {"/", 6, 0, 0, [](double a, double b) { return b == 0 ? NAN : a / b; }},
    {"%", 6, 0, 0, [](double a, double b) { return b == 0 ? NAN : a - b * std::floor(a / b); }},
    {"==", 4},
    {"!=", 4},
    {"<", 4, 0, 0, [](double a, double b) { return a < b ? 1.0 : 0.0; }},
    {"<=", 4, 0, 0, [](double a, double b) { return a <= b ? 1.0 : 0.0; }},
    {">", 4, 0, 0, [](double a, double b) { return a > b ? 1.0 : 0.0; }},
    {">=", 4, 0, 0, [](double a, double b) { return a >= b ? 1.0 : 0.0; }},
    {"&&", 3},
    {"||", 2},
    {"?", 1},
    {"min", 0, 2, 8, [](double a, double b) { return b < a ? b : a; }},
    {"max", 0, 2, 8, [](double a, double b) { return b > a ? b : a; }},
    {"ceil", 0, 1, 1, [](double a, double) { return std::ceil(a); }},
    {"floor", 0, 1, 1, [](double a, double) { return std::floor(a); }},
    {"log2ceil", 0, 1, 1, [](double a, double) { return a > 0 ? log2ceil(a) : NAN; }},
    {"pow2ceil", 0, 1, 1, [](double a, double) { return a <= 1 ? 1 : std::exp2(log2ceil(a)); }},
    {"abs", 0, 1, 1, [](double a, double) { return std::fabs(a); }},
    {"round", 0, 1, 1, [](double a, double) { return std::round(a); }},
    {"pow2", 0, 1, 1, [](double a, double) { return std::exp2(a); }},
    {"log2", 0, 1, 1, [](double a, double) { return a > 0 ? std::log2(a) : NAN; }}};
constexpr auto kFirstOp = static_cast<std::size_t>(ExprOp::component);
static_assert(std::size(kOps) == static_cast<std::size_t>(kLastOp) - kFirstOp + 1);

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
  static constexpr const char* kNames[] = {"size", "mips", "count", "has", "age", "format", ""};
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
  node->place = place;
  setChildren(*node, std::move(children));
  return node;
}

void setChildren(ExprNode& node, std::vector<ExprPtr> children) {
  const int height = heightOver(children);
  assert(height <= kMaxExprHeight + 1);
  node.height = static_cast<std::uint8_t>(height);
  node.dynamic = node.live = node.watched = false;
  for (const ExprPtr& child : children) {
    node.dynamic = node.dynamic || child->dynamic;
    node.live = node.live || child->live;
    node.watched = node.watched || child->watched;
  }
  node.terms = termsOver(children);
  node.children = std::move(children);
}

ExprPtr makeConstant(Value value, text::Place place) {
  auto node = std::make_shared<ExprNode>();
  node->value = std::move(value);
  node->place = place;
  return node;
}

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
  return {std::move(node), place};
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
  if (value.count == items.size()) return constant(std::move(value), place);
  Expr made(makeNode(ExprOp::list, place, std::move(children)), place);
  for (const Expr& item : items) made.source_ += (made.source_.empty() ? "[" : ", ") + item.text();
  made.source_ += ']';
  return made;
}

Expr Expr::both(const Expr& a, const Expr& b) {
  const auto says = [](const Expr& expr) { return expr.isConstant() && expr.text() == "false"; };
  if (!a.present() || says(b)) return b;
  if (!b.present() || says(a)) return a;
  Expr made(makeNode(ExprOp::logical_and, a.place(), {a.root_, b.root_}), a.place());
  const auto part = [](const std::string& text) {
    return text.find_first_of("|?") == std::string::npos ? text : "(" + text + ")";
  };
  made.source_ = part(a.text()) + " && " + part(b.text());
  return made;
}

std::optional<Expr> Expr::parse(std::string_view text, const text::Place& place,
                                text::Diagnostics& diagnostics) {
  ExprPtr root = parseExprTree(text, place, diagnostics);
  if (!root) return std::nullopt;
  Expr parsed(std::move(root), place);
  if (!parsed.isConstant()) parsed.source_ = text;
  return parsed;
}

bool Expr::dynamic() const {
  return root_ && root_->dynamic;
}

bool Expr::live() const {
  return root_ && root_->live;
}

bool Expr::watched() const {
  return root_ && root_->watched;
}

Expr Expr::column(std::uint8_t part) const {
  auto node = std::make_shared<ExprNode>(*root_);
  node->part = part;
  return {std::move(node), start_};
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
  return !source_.empty() || !root_ ? source_ : toText(root_->value);
}

const std::vector<std::string>& Expr::variables() const {
  static const std::vector<std::string> kNoNames;
  return variables_ ? *variables_ : kNoNames;
}

const std::string* Expr::onlyVariable() const {
  return root_ && root_->op == ExprOp::variable ? &root_->name : nullptr;
}

bool Expr::says(std::string_view word) const {
  bool found = false;
  if (root_)
    visitNodes(*root_, [&](const ExprNode& node) {
      found = found || (node.op == ExprOp::identifier && node.name == word);
    });
  return found;
}

std::vector<std::pair<Fact, std::string_view>> Expr::facts() const {
  std::vector<std::pair<Fact, std::string_view>> out;
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
  if (std::string foreign = text::hintForForeign("value", value.symbol); !foreign.empty()) return foreign;
  std::vector<std::string> known = scope.candidates(EvalScope::NameKind::builtin);
  for (const std::string& name : variables) known.push_back("$" + name);
  const std::string near = text::nearestName(value.symbol, known);
  return near.empty() ? "a bare word is an index of \"repeat\" or 'screen'; a parameter begins with '$'"
                      : fmt::format("did you mean '{}'?", near);
}

// ---- evaluation ----

namespace {

// What an operand is, for messages: "the number 2", "a list of 2", "the word 'fill'".
std::string describe(const Value& value) {
  if (value.type == Value::Type::number) return fmt::format("the number {}", toText(value));
  if (value.type == Value::Type::list) return fmt::format("a list of {}", value.count);
  return value.type == Value::Type::symbol ? fmt::format("the word '{}'", value.symbol) : toText(value);
}

bool isFinite(const Value& value) {
  return std::all_of(value.v.begin(), value.v.begin() + value.count,
                     [](double x) { return std::isfinite(x); });
}

class Evaluator {
 public:
  // Without diagnostics nothing is reported.
  Evaluator(EvalScope& scope, text::Diagnostics* diagnostics) : scope_(scope), diagnostics_(diagnostics) {}

  Value run(const ExprNode& node) {
    switch (node.op) {
      case ExprOp::constant:
        return node.value;
      case ExprOp::list:
        return list(node);
      case ExprOp::variable:
        return variable(node);
      case ExprOp::identifier:
        return identifier(node);
      case ExprOp::builtin:
        return builtin(node);
      case ExprOp::fact:
        return fact(node);
      case ExprOp::age_key:
        return Value::number(scope_.age(node.key));
      case ExprOp::parameter_key:
        return scope_.parameter(node.key);
      case ExprOp::component:
        return component(node);
      case ExprOp::logical_not: {
        const Value operand = run(*node.children[0]);
        return fits(operand, *node.children[0], node) ? Value::boolean(!operand.truth()) : Value{};
      }
      case ExprOp::logical_and:
      case ExprOp::logical_or:
        return logical(node);
      case ExprOp::conditional: {
        const Value chosen = run(*node.children[0]);
        if (!fits(chosen, *node.children[0], node)) return {};
        return run(*node.children[chosen.truth() ? 1 : 2]);
      }
      case ExprOp::equal:
      case ExprOp::not_equal:
        return equality(node);
      case ExprOp::less:
      case ExprOp::less_equal:
      case ExprOp::greater:
      case ExprOp::greater_equal:
        return order(node);
      default:
        return arithmetic(node);
    }
  }

  // ---- names; also used by check() ----

  Value variable(const ExprNode& node) {
    if (std::optional<Value> value = scope_.variable(node.name)) return *std::move(value);
    return unknown(node, fmt::format("unknown variable '${}'", node.name), EvalScope::NameKind::variable,
                   "$");
  }

  Value builtin(const ExprNode& node) {
    if (std::optional<Value> value = scope_.builtin(node.name)) return *std::move(value);
    return unknown(node, fmt::format("unknown value '{}'", node.name), EvalScope::NameKind::builtin, "");
  }

  // False, with a message, when one side is a choice parameter and the other a word that is no choice of it.
  bool choicesFit(const ExprNode& node) {
    return choiceFits(*node.children[0], *node.children[1]) &&
           choiceFits(*node.children[1], *node.children[0]);
  }

 private:
  template <class... Args>
  Value fail(text::Saying<Args...> what, const ExprNode& node, Args&&... args) {
    if (diagnostics_) diagnostics_->error<Args...>(what, node.place, std::forward<Args>(args)...);
    return {};
  }

  Value unknown(const ExprNode& node, std::string message, EvalScope::NameKind kind, const char* sigil) {
    std::vector<std::string> names = scope_.candidates(kind);
    std::ranges::sort(names);
    const std::string &name = node.name, nearest = text::nearestName(name, names);
    const bool variable = kind == EvalScope::NameKind::variable;
    const bool bare = variable && (scope_.index(name) || scope_.builtin(name));
    std::string hint =
        bare ? fmt::format("write '{}', without the '$'", name) : text::hintForForeign("value", name);
    const bool misspelt = hint.empty() && !nearest.empty();
    if (misspelt) hint = fmt::format("did you mean '{}{}'?", sigil, nearest);
    if (hint.empty()) hint = text::nearestHint(name, names);
    fail(say::unknownName, node, message, hint);
    // It is read as the one that is meant, so that nothing else is reported because of it.
    return misspelt && variable ? scope_.variable(nearest).value_or(Value{}) : Value{};
  }

  Value identifier(const ExprNode& node) { return scope_.index(node.name).value_or(Value::text(node.name)); }

  Value fact(const ExprNode& node) {
    constexpr double kMost = 65535;
    const Value which = node.children.empty() ? Value::number(0) : run(*node.children[0]);
    if (!which.isNumeric() || which.v[0] != std::floor(which.v[0]) || which.v[0] < 0 || which.v[0] > kMost)
      return misfit(say::levelNotWhole, *node.children[0], which);
    const auto index = static_cast<std::uint32_t>(which.v[0]);
    if (node.fact == Fact::value)
      return scope_.importValue({node.name, node.value.symbol, index, node.part}, node.place);
    if (std::optional<Value> value = scope_.fact(node.fact, node.name, index, node.place))
      return *std::move(value);
    if (node.fact == Fact::age && scope_.ageKey(node.name)) return fail(say::ageNotKnownYet, node, node.name);
    return unknown(node, fmt::format("{}() of unknown resource '{}'", nameOf(node.fact), node.name),
                   EvalScope::NameKind::fact_argument, "");
  }

  template <class... Args>
  Value misfit(text::Saying<Args...> what, const ExprNode& blamed, const Value& operand, Args&&... args) {
    if (operand.type == Value::Type::none || !diagnostics_) return {};
    auto& d = diagnostics_->error<Args...>(what, blamed.place, std::forward<Args>(args)...);
    d.found = describe(operand);
    d.hint = hintForWord(scope_, operand);
    return {};
  }

  // Whether an operand is a number or, where `lists` may be, a list; else it is reported.
  bool fits(const Value& operand, const ExprNode& from, const ExprNode& node, bool lists = false) {
    const bool good = operand.isNumeric() || (lists && operand.type == Value::Type::list);
    const char* const sign = infoOf(node.op).spelling;
    if (!good)
      lists ? misfit(say::needsNumber, from, operand, sign)
            : misfit(say::needsCondition, from, operand, sign);
    return good;
  }

  Value list(const ExprNode& node) {
    Value out;
    out.type = Value::Type::list;
    for (const ExprPtr& child : node.children) {
      const Value item = run(*child);
      if (!item.isNumeric()) return misfit(say::listHoldsNumbers, *child, item);
      out.v[out.count++] = item.v[0];
    }
    return out;
  }

  Value component(const ExprNode& node) {
    const Value operand = run(*node.children[0]);
    if (operand.type != Value::Type::list || node.key >= operand.count)
      return misfit(say::noSuchComponent, node, operand, "xyzw"[node.key], node.key + 1);
    return Value::number(operand.v[node.key]);
  }

  Value logical(const ExprNode& node) {
    const Value left = run(*node.children[0]);
    if (!fits(left, *node.children[0], node)) return {};
    if (left.truth() == (node.op == ExprOp::logical_or)) return Value::boolean(left.truth());
    const Value right = run(*node.children[1]);
    return fits(right, *node.children[1], node) ? Value::boolean(right.truth()) : Value{};
  }

  bool choiceFits(const ExprNode& parameter, const ExprNode& word) {
    const bool symbol = word.op == ExprOp::identifier
                            ? !scope_.index(word.name).has_value()
                            : word.op == ExprOp::constant && word.value.type == Value::Type::symbol;
    if (!symbol || parameter.op != ExprOp::variable) return true;
    const std::vector<std::string> choices = scope_.choicesOf(parameter.name);
    const std::string& found = word.op == ExprOp::identifier ? word.name : word.value.symbol;
    if (choices.empty() || std::ranges::find(choices, found) != choices.end()) return true;
    fail(say::notAChoice, word, found, parameter.name, fmt::join(choices, ", "),
         text::nearestHint(found, choices));
    return false;
  }

  Value equality(const ExprNode& node) {
    const Value left = run(*node.children[0]);
    const Value right = run(*node.children[1]);
    if (left.type == Value::Type::none || right.type == Value::Type::none || !choicesFit(node)) return {};
    const auto bare = [&](const ExprPtr& side) {
      return side->op == ExprOp::identifier && !scope_.index(side->name);
    };
    if (bare(node.children[0]) && bare(node.children[1]))
      return fail(say::comparesBareWords, *node.children[0], left.symbol, right.symbol,
                  hintForWord(scope_, left));
    const bool comparable =
        left.isNumeric() ? right.isNumeric() : left.type == right.type && left.count == right.count;
    if (!comparable)
      return fail(say::cannotCompare, node, infoOf(node.op).spelling, describe(left), describe(right),
                  hintForWord(scope_, left.type == Value::Type::symbol ? left : right));
    const bool same = left.isNumeric()                 ? left.v[0] == right.v[0]
                      : left.type == Value::Type::list ? left.v == right.v
                                                       : left.symbol == right.symbol;
    return Value::boolean(same == (node.op == ExprOp::equal));
  }

  Value order(const ExprNode& node) {
    const Value left = run(*node.children[0]);
    const Value right = run(*node.children[1]);
    if (left.type == Value::Type::none || right.type == Value::Type::none) return {};
    for (const Value* operand : {&left, &right})
      if (!operand->isNumeric())
        return misfit(say::comparesNumbers,
                      operand->type == Value::Type::symbol ? *node.children[operand == &left ? 0 : 1] : node,
                      *operand, infoOf(node.op).spelling);
    return Value::boolean(infoOf(node.op).apply(left.v[0], right.v[0]) != 0);
  }

  Value apply(const ExprNode& node, const Value& left, const Value& right) {
    const bool listLeft = left.type == Value::Type::list, listRight = right.type == Value::Type::list;
    const auto operands = [&] { return fmt::format("{} and {}", toText(left), toText(right)); };
    if (listLeft && listRight && left.count != right.count)
      return fail(say::listsDifferInLength, node, infoOf(node.op).spelling, operands());
    const auto combine = infoOf(node.op).apply;
    Value out;
    out.type = listLeft || listRight ? Value::Type::list : Value::Type::number;
    out.count = listLeft ? left.count : listRight ? right.count : std::uint8_t{1};
    for (std::size_t i = 0; i < out.count; ++i) {
      const double a = left.v[listLeft ? i : 0];
      const double b = right.v[listRight ? i : 0];
      out.v[i] = combine(a, b);
      // Infinite ages pass through; a NaN, or an infinity made of finite operands, does not.
      if (std::isnan(out.v[i]) || (!std::isfinite(out.v[i]) && isFinite(left) && isFinite(right)))
        return fail(say::hasNoFiniteResult, node, infoOf(node.op).spelling, operands());
    }
    return out;
  }

  Value arithmetic(const ExprNode& node) {
    Value left = run(*node.children[0]);
    if (!fits(left, *node.children[0], node, true)) return {};
    if (node.children.size() == 1) return apply(node, left, Value::number(0));
    for (std::size_t i = 1; i < node.children.size(); ++i) {
      const Value right = run(*node.children[i]);
      if (!fits(right, *node.children[i], node, true)) return {};
      left = apply(node, left, right);
      if (left.type == Value::Type::none) return {};
    }
    return left;
  }

  EvalScope& scope_;
  text::Diagnostics* diagnostics_;
};

// Of a folded tree: ages and the values of live parameters.
class FoldedScope final : public EvalScope {
 public:
  FoldedScope(const AgeFunction& age, std::span<const Value> parameters)
      : age_(age), parameters_(parameters) {}
  double age(std::uint32_t key) override { return age_ ? age_(key) : 0; }
  Value parameter(std::uint32_t key) override {
    return key < parameters_.size() ? parameters_[key] : Value{};
  }

 private:
  const AgeFunction& age_;
  std::span<const Value> parameters_;
};

bool checkNode(const ExprNode& node, EvalScope& scope, text::Diagnostics& diagnostics) {
  Evaluator evaluator(scope, &diagnostics);
  const std::size_t before = diagnostics.errorCount();
  if (node.op == ExprOp::variable) evaluator.variable(node);
  if (node.op == ExprOp::builtin) evaluator.builtin(node);
  if (node.op == ExprOp::equal || node.op == ExprOp::not_equal) evaluator.choicesFit(node);
  for (const ExprPtr& child : node.children) checkNode(*child, scope, diagnostics);
  return diagnostics.errorCount() == before;
}

}  // namespace

Value Expr::evaluate(EvalScope& scope, text::Diagnostics& diagnostics) const {
  return root_ ? Evaluator(scope, &diagnostics).run(*root_) : Value{};
}

bool Expr::check(EvalScope& scope, text::Diagnostics& diagnostics) const {
  return !root_ || checkNode(*root_, scope, diagnostics);
}

Value Expr::evaluateFolded(const AgeFunction& age, std::span<const Value> parameters,
                           text::Diagnostics* diagnostics) const {
  FoldedScope scope(age, parameters);
  return root_ ? Evaluator(scope, diagnostics).run(*root_) : Value{};
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
    changes = changes || (node.op == ExprOp::fact && node.fact == Fact::value && scope.keepsImports()) ||
              (node.op == ExprOp::variable && scope.folded(node.name, node.place));
  });
  return changes;
}

// Null after an error.
ExprPtr foldNode(const ExprPtr& node, EvalScope& scope, text::Diagnostics& diagnostics) {
  if (node->folded) return node;
  if (node->op == ExprOp::variable)
    if (auto folded = scope.folded(node->name, node->place)) return *std::move(folded);
  if (!changesLater(*node, scope)) {
    Value value = Evaluator(scope, &diagnostics).run(*node);
    return value.type == Value::Type::none ? nullptr : makeConstant(std::move(value), node->place);
  }
  if (node->op == ExprOp::fact && node->fact != Fact::age) {
    const ExprNode* const which = node->children.empty() ? nullptr : node->children[0].get();
    const Value index = which ? Evaluator(scope, &diagnostics).run(*which) : Value::number(0);
    if ((which && changesLater(*which, scope)) || index.type == Value::Type::none) return nullptr;
    const std::optional<std::uint32_t> key =
        scope.importKey({node->name, node->value.symbol, static_cast<std::uint32_t>(index.v[0]), node->part});
    return key ? Expr::parameter(*key, node->place).tree() : nullptr;
  }
  if (node->op == ExprOp::fact) {
    const std::optional<std::uint32_t> key = scope.ageKey(node->name);
    if (!key) {
      if (scope.fact(Fact::age, node->name, 0, node->place)) return nullptr;  // reported
      diagnostics.error(say::ageOfUnknown, node->place, node->name,
                        text::nearestHint(node->name, scope.candidates(EvalScope::NameKind::fact_argument)));
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
    diagnostics.error(say::timedExpressionTooLong, node->place, kMaxFoldedTerms);
    return nullptr;
  }
  auto folded = std::make_shared<ExprNode>(*node);
  setChildren(*folded, std::move(children));
  folded->folded = true;
  if (folded->dynamic || folded->live) return folded;
  Value value = Evaluator(scope, &diagnostics).run(*folded);
  return value.type == Value::Type::none ? nullptr : makeConstant(std::move(value), node->place);
}

}  // namespace

Expr Expr::fold(EvalScope& scope, text::Diagnostics& diagnostics) const {
  const ExprPtr folded = root_ ? foldNode(root_, scope, diagnostics) : nullptr;
  if (!folded) return {};
  if (folded->dynamic && !folded->live) {  // else the caller knows the values of the parameters
    const AgeFunction trialAge = [](std::uint32_t) { return kTrialAge; };
    if (Expr(folded, start_).evaluateFolded(trialAge, {}, &diagnostics).type == Value::Type::none) return {};
  }
  return {folded, start_};
}

}  // namespace weft::graph
