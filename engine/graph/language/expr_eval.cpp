// Evaluation and checking of expression trees. One evaluator serves both the static case (a scope,
// with diagnostics) and the folded one (an age function, silent). Declared in expr_node.h and expr.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "engine/graph/language/expr_node.h"
#include "engine/text/nearest.h"
#include "engine/text/words/foreign_words.h"

namespace weft::graph {

namespace {

using text::Code;

// ---- numbers ----

// Smallest k >= 0 with 2^k >= x, for x > 0. Exact.
double log2ceil(double x) {
  if (x <= 1) return 0;
  if (std::isinf(x)) return x;
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);  // x = mantissa * 2^exponent, mantissa in [0.5, 1)
  return mantissa == 0.5 ? exponent - 1 : exponent;
}

// The result of an arithmetic operator or function for one component; `b` is ignored where there is one operand. NaN marks a
// domain error.
double combine(ExprOp op, double a, double b) {
  switch (op) {
    case ExprOp::add:
      return a + b;
    case ExprOp::subtract:
      return a - b;
    case ExprOp::multiply:
      return a * b;
    case ExprOp::divide:
      return b == 0 ? NAN : a / b;
    case ExprOp::modulo:
      return b == 0 ? NAN : a - b * std::floor(a / b);
    case ExprOp::minimum:
      return b < a ? b : a;
    case ExprOp::maximum:
      return b > a ? b : a;
    case ExprOp::negate:
      return -a;
    case ExprOp::ceil:
      return std::ceil(a);
    case ExprOp::floor:
      return std::floor(a);
    case ExprOp::log2ceil:
      return a > 0 ? log2ceil(a) : NAN;
    case ExprOp::pow2ceil:
      return a <= 1 ? 1 : std::exp2(log2ceil(a));
    case ExprOp::abs:
      return std::fabs(a);
    case ExprOp::less:
      return a < b ? 1 : 0;
    case ExprOp::less_equal:
      return a <= b ? 1 : 0;
    case ExprOp::greater:
      return a > b ? 1 : 0;
    case ExprOp::greater_equal:
      return a >= b ? 1 : 0;
    default:
      return NAN;
  }
}

// ---- values ----

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

// What a message says beside its sentence.
struct Said {
  std::string expected{}, found{}, hint{};
};

class Evaluator {
 public:
  Evaluator(EvalScope& scope, text::Diagnostics& diagnostics) : scope_(&scope), diagnostics_(&diagnostics) {}
  // A folded tree: no scope, but ages and parameters, and perhaps no diagnostics.
  Evaluator(const AgeFunction& age, std::span<const Value> parameters, text::Diagnostics* diagnostics)
      : age_(&age), parameters_(parameters), diagnostics_(diagnostics) {}

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
        return Value::number(age_ ? (*age_)(node.key) : 0);
      case ExprOp::parameter_key:
        return node.key < parameters_.size() ? parameters_[node.key] : Value{};
      case ExprOp::component:
        return component(node);
      case ExprOp::logical_not: {
        const Value operand = run(*node.children[0]);
        return condition(operand, *node.children[0], node) ? Value::boolean(!operand.truth()) : Value{};
      }
      case ExprOp::logical_and:
      case ExprOp::logical_or:
        return logical(node);
      case ExprOp::conditional: {
        const Value chosen = run(*node.children[0]);
        if (!condition(chosen, *node.children[0], node)) return {};
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
    if (!scope_) return {};
    if (std::optional<Value> value = scope_->variable(node.name)) return *std::move(value);
    return unknown(node, fmt::format("unknown variable '${}'", node.name), EvalScope::NameKind::variable,
                   "$");
  }

  Value builtin(const ExprNode& node) {
    if (!scope_) return {};
    if (std::optional<Value> value = scope_->builtin(node.name)) return *std::move(value);
    return unknown(node, fmt::format("unknown value '{}'", node.name), EvalScope::NameKind::builtin, "");
  }

  // False, with a message, when one side is a choice parameter and the other a word that is none of its
  // choices.
  bool choicesFit(const ExprNode& node) {
    return choiceFits(*node.children[0], *node.children[1]) &&
           choiceFits(*node.children[1], *node.children[0]);
  }

 private:
  Value fail(Code code, const ExprNode& node, std::string message, Said said = {}) {
    if (!diagnostics_) return {};
    text::Diagnostic& d = diagnostics_->error(code, node.place, std::move(message));
    d.expected = std::move(said.expected);
    d.found = std::move(said.found);
    d.hint = std::move(said.hint);
    return {};
  }

  Value unknown(const ExprNode& node, std::string message, EvalScope::NameKind kind, const char* sigil) {
    std::vector<std::string> names = scope_->candidates(kind);
    std::ranges::sort(names);
    const std::string &name = node.name, nearest = text::nearestName(name, names);
    const bool variable = kind == EvalScope::NameKind::variable;
    const bool bare = variable && (scope_->index(name) || scope_->builtin(name));
    const std::string foreign = text::hintForForeign(text::Foreign::value, name);
    const bool misspelt = !bare && foreign.empty() && !nearest.empty();
    std::string hint = bare       ? fmt::format("write '{}', without the '$'", name)
                       : misspelt ? fmt::format("did you mean '{}{}'?", sigil, nearest)
                                  : foreign;
    if (hint.empty()) hint = text::nearestHint(name, names);
    fail(Code::unknownVariable, node, std::move(message), {.hint = std::move(hint)});
    // It is read as the one that is meant, so that nothing else is reported because of it.
    return misspelt && variable ? scope_->variable(nearest).value_or(Value{}) : Value{};
  }

  Value identifier(const ExprNode& node) {
    if (scope_)
      if (std::optional<Value> value = scope_->index(node.name)) return *std::move(value);
    return Value::text(node.name);
  }

  Value fact(const ExprNode& node) {
    if (!scope_) return {};
    if (std::optional<Value> value = scope_->fact(node.fact, node.name, node.place)) return *std::move(value);
    if (node.fact == Fact::age && scope_->ageKey(node.name))
      return fail(
          Code::operandsDoNotFit, node, fmt::format("age({}) is not known before the frame runs", node.name),
          {.hint =
               "age() may stand in parameters and \"instances\" of passes and in \"let\" used by them, not "
               "in sizes, conditions, repeats or defines"});
    return unknown(node, fmt::format("{}() of unknown resource '{}'", nameOf(node.fact), node.name),
                   EvalScope::NameKind::fact_argument, "");
  }

  Value misfit(const ExprNode& blamed, std::string message, std::string expected, const Value& operand) {
    return operand.type == Value::Type::none
               ? Value{}
               : fail(Code::operandsDoNotFit, blamed, std::move(message),
                      {std::move(expected), describe(operand), scope_ ? hintForWord(*scope_, operand) : ""});
  }

  bool condition(const Value& operand, const ExprNode& from, const ExprNode& node) {
    if (!operand.isNumeric())
      misfit(from, fmt::format("'{}' needs a condition", infoOf(node.op).spelling), "true, false or a number",
             operand);
    return operand.isNumeric();
  }

  Value list(const ExprNode& node) {
    Value out;
    out.type = Value::Type::list;
    for (const ExprPtr& child : node.children) {
      const Value item = run(*child);
      if (!item.isNumeric())
        return misfit(*child, "a list holds numbers", "a number, such as 'screen.x' or 'size(a).y'", item);
      out.v[out.count++] = item.v[0];
    }
    return out;
  }

  Value component(const ExprNode& node) {
    const Value operand = run(*node.children[0]);
    if (operand.type != Value::Type::list || node.key >= operand.count)
      return misfit(node, fmt::format("'.{}' of what has no such component", "xyzw"[node.key]),
                    fmt::format("a list of at least {}", node.key + 1), operand);
    return Value::number(operand.v[node.key]);
  }

  Value logical(const ExprNode& node) {
    const Value left = run(*node.children[0]);
    if (!condition(left, *node.children[0], node)) return {};
    if (left.truth() == (node.op == ExprOp::logical_or)) return Value::boolean(left.truth());
    const Value right = run(*node.children[1]);
    return condition(right, *node.children[1], node) ? Value::boolean(right.truth()) : Value{};
  }

  bool choiceFits(const ExprNode& parameter, const ExprNode& word) {
    if (!scope_ || parameter.op != ExprOp::variable) return true;
    const bool symbol = word.op == ExprOp::identifier
                            ? !scope_->index(word.name).has_value()
                            : word.op == ExprOp::constant && word.value.type == Value::Type::symbol;
    if (!symbol) return true;
    const std::vector<std::string> choices = scope_->choicesOf(parameter.name);
    const std::string& found = word.op == ExprOp::identifier ? word.name : word.value.symbol;
    if (choices.empty() || std::find(choices.begin(), choices.end(), found) != choices.end()) return true;
    const std::string nearest = text::nearestName(found, choices);
    fail(Code::notAChoice, word,
         fmt::format("'{}' is not one of the choices of '${}'", found, parameter.name),
         {fmt::format("{}", fmt::join(choices, ", ")), found,
          nearest.empty() ? "" : fmt::format("did you mean '{}'?", nearest)});
    return false;
  }

  Value equality(const ExprNode& node) {
    const Value left = run(*node.children[0]);
    const Value right = run(*node.children[1]);
    if (left.type == Value::Type::none || right.type == Value::Type::none || !choicesFit(node)) return {};
    const auto bare = [&](const ExprPtr& side) {
      return scope_ && side->op == ExprOp::identifier && !scope_->index(side->name);
    };
    if (bare(node.children[0]) && bare(node.children[1]))
      return fail(Code::unknownVariable, *node.children[0],
                  fmt::format("'{}' and '{}' are bare words: comparing them always gives the same",
                              left.symbol, right.symbol),
                  {"a parameter or an index of \"repeat\" on one side", "", hintForWord(*scope_, left)});
    const bool comparable = left.isNumeric() ? right.isNumeric()
                            : left.type == Value::Type::list
                                ? right.type == Value::Type::list && left.count == right.count
                                : right.type == Value::Type::symbol;
    if (!comparable)
      return fail(
          Code::operandsDoNotFit, node,
          fmt::format("'{}' compares {} with {}", infoOf(node.op).spelling, describe(left), describe(right)),
          {"two numbers, two lists of one length, or two words", "",
           scope_ ? hintForWord(*scope_, left.type == Value::Type::symbol ? left : right) : ""});
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
        return misfit(operand->type == Value::Type::symbol ? *node.children[operand == &left ? 0 : 1] : node,
                      fmt::format("'{}' compares numbers only", infoOf(node.op).spelling), "a number",
                      *operand);
    return Value::boolean(combine(node.op, left.v[0], right.v[0]) != 0);
  }

  bool arithmeticOperand(const Value& operand, const ExprNode& from, const ExprNode& node) {
    const bool good = operand.isNumeric() || operand.type == Value::Type::list;
    if (!good)
      misfit(from, fmt::format("'{}' needs numbers", infoOf(node.op).spelling), "a number or a list",
             operand);
    return good;
  }

  Value noResult(const ExprNode& node, const Value& left, const Value& right, bool binary) {
    const char* spelling = infoOf(node.op).spelling;
    const auto end = right.v.begin() + right.count;
    const bool byZero = (node.op == ExprOp::divide || node.op == ExprOp::modulo) &&
                        std::find(right.v.begin(), end, 0.0) != end;
    return fail(Code::noFiniteResult, node, fmt::format("'{}' has no finite result", spelling),
                {byZero                        ? "a divisor that is not zero"
                 : node.op == ExprOp::log2ceil ? "a number above zero"
                                               : "a result that a double can hold",
                 binary ? fmt::format("{} {} {}", toText(left), spelling, toText(right))
                        : fmt::format("{}({})", spelling, toText(left)),
                 byZero ? "guard it: 'b == 0 ? 0 : a / b'" : ""});
  }

  Value apply(const ExprNode& node, const Value& left, const Value& right, bool binary) {
    const bool listLeft = left.type == Value::Type::list, listRight = right.type == Value::Type::list;
    if (listLeft && listRight && left.count != right.count)
      return fail(Code::operandsDoNotFit, node,
                  fmt::format("'{}' of two lists that differ in length", infoOf(node.op).spelling),
                  {describe(left), describe(right)});
    Value out;
    out.type = listLeft || listRight ? Value::Type::list : Value::Type::number;
    out.count = listLeft ? left.count : listRight ? right.count : std::uint8_t{1};
    for (std::size_t i = 0; i < out.count; ++i) {
      const double a = left.v[listLeft ? i : 0];
      const double b = right.v[listRight ? i : 0];
      out.v[i] = combine(node.op, a, b);
      // Infinite ages pass through; a NaN, or an infinity made of finite operands, does not.
      if (std::isnan(out.v[i]) || (!std::isfinite(out.v[i]) && isFinite(left) && isFinite(right)))
        return noResult(node, left, right, binary);
    }
    return out;
  }

  Value arithmetic(const ExprNode& node) {
    Value left = run(*node.children[0]);
    if (!arithmeticOperand(left, *node.children[0], node)) return {};
    if (node.children.size() == 1) return apply(node, left, Value::number(0), false);
    for (std::size_t i = 1; i < node.children.size(); ++i) {
      const Value right = run(*node.children[i]);
      if (!arithmeticOperand(right, *node.children[i], node)) return {};
      left = apply(node, left, right, true);
      if (left.type == Value::Type::none) return {};
    }
    return left;
  }

  EvalScope* scope_ = nullptr;
  const AgeFunction* age_ = nullptr;
  std::span<const Value> parameters_;
  text::Diagnostics* diagnostics_ = nullptr;
};

bool checkNode(const ExprNode& node, EvalScope& scope, text::Diagnostics& diagnostics) {
  Evaluator evaluator(scope, diagnostics);
  const std::size_t before = diagnostics.errorCount();
  if (node.op == ExprOp::variable) evaluator.variable(node);
  if (node.op == ExprOp::builtin) evaluator.builtin(node);
  if (node.op == ExprOp::equal || node.op == ExprOp::not_equal) evaluator.choicesFit(node);
  for (const ExprPtr& child : node.children) checkNode(*child, scope, diagnostics);
  return diagnostics.errorCount() == before;
}

}  // namespace

Value evaluateNode(const ExprNode& node, EvalScope& scope, text::Diagnostics& diagnostics) {
  return Evaluator(scope, diagnostics).run(node);
}

Value evaluateNode(const ExprNode& node, const AgeFunction& age, std::span<const Value> parameters,
                   text::Diagnostics* diagnostics) {
  return Evaluator(age, parameters, diagnostics).run(node);
}

Value Expr::evaluate(EvalScope& scope, text::Diagnostics& diagnostics) const {
  return root_ ? Evaluator(scope, diagnostics).run(*root_) : Value{};
}

bool Expr::check(EvalScope& scope, text::Diagnostics& diagnostics) const {
  return !root_ || checkNode(*root_, scope, diagnostics);
}

Value Expr::evaluateFolded(const std::function<double(std::uint32_t key)>& age,
                           std::span<const Value> parameters) const {
  return root_ ? evaluateNode(*root_, age, parameters, nullptr) : Value{};
}

}  // namespace weft::graph
