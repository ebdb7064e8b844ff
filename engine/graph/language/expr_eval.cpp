// Evaluation and checking of expression trees. One evaluator serves both the static case (a scope,
// with diagnostics) and the folded one (an age function, silent). Declared in expr_node.h and expr.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/nearest.h"
#include "engine/base/words/foreign_words.h"
#include "engine/graph/language/expr_node.h"

namespace weft::graph {

namespace {

using base::Code;

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
    default:
      return NAN;
  }
}

// ---- values ----

// What an operand is, for messages: "the number 2", "a list of 2", "the symbol 'fill'".
std::string describe(const Value& value) {
  switch (value.type) {
    case Value::Type::number:
      return fmt::format("the number {}", toText(value));
    case Value::Type::boolean:
      return toText(value);
    case Value::Type::list:
      return fmt::format("a list of {}", value.count);
    case Value::Type::symbol:
      return fmt::format("the word '{}'", value.symbol);
    case Value::Type::none:
      break;
  }
  return "no value";
}

bool isFinite(const Value& value) {
  return std::all_of(value.v.begin(), value.v.begin() + value.count,
                     [](double x) { return std::isfinite(x); });
}

class Evaluator {
 public:
  Evaluator(EvalScope& scope, base::Diagnostics& diagnostics) : scope_(&scope), diagnostics_(&diagnostics) {}
  // A folded tree: no scope, but ages and parameters, and perhaps no diagnostics.
  Evaluator(const AgeFunction& age, std::span<const Value> parameters, base::Diagnostics* diagnostics)
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
    return unknown(node, fmt::format("unknown variable '${}'", node.name), node.name,
                   EvalScope::NameKind::variable, "$");
  }

  Value builtin(const ExprNode& node) {
    if (!scope_) return {};
    if (std::optional<Value> value = scope_->builtin(node.name)) return *std::move(value);
    return unknown(node, fmt::format("unknown value '{}'", node.name), node.name,
                   EvalScope::NameKind::builtin, "");
  }

  // False, with a message, when one side is a choice parameter and the other a word that is none of its
  // choices.
  bool choicesFit(const ExprNode& node) {
    return choiceFits(*node.children[0], *node.children[1]) &&
           choiceFits(*node.children[1], *node.children[0]);
  }

 private:
  base::Diagnostic* error(Code code, const ExprNode& node, std::string message) {
    return diagnostics_ ? &diagnostics_->error(code, node.place, std::move(message)) : nullptr;
  }

  Value unknown(const ExprNode& node, std::string message, std::string_view name, EvalScope::NameKind kind,
                const char* sigil) {
    if (base::Diagnostic* d = error(Code::unknownVariable, node, std::move(message))) {
      std::vector<std::string> names = scope_->candidates(kind);
      std::sort(names.begin(), names.end());
      const bool index = kind == EvalScope::NameKind::variable && scope_->index(name);
      if (index || std::ranges::count(scope_->candidates(EvalScope::NameKind::builtin), name) > 0)
        d->hint = fmt::format("write '{}', without the '$'{}", name, index ? ": it is an index" : "");
      else if (std::string foreign = base::hintForForeign(base::Foreign::value, name); !foreign.empty())
        d->hint = std::move(foreign);
      else if (const std::string nearest = base::nearestName(name, names); !nearest.empty()) {
        d->hint = fmt::format("did you mean '{}{}'?", sigil, nearest);
        // It is read as the one that is meant, so that nothing else is reported because of it.
        if (kind == EvalScope::NameKind::variable) return scope_->variable(nearest).value_or(Value{});
      } else {
        d->hint = base::nearestHint(name, names);
      }
    }
    return {};
  }

  Value identifier(const ExprNode& node) {
    if (scope_)
      if (std::optional<Value> value = scope_->index(node.name)) return *std::move(value);
    return Value::text(node.name);
  }

  Value fact(const ExprNode& node) {
    if (!scope_) return {};
    if (std::optional<Value> value = scope_->fact(node.fact, node.name, node.place)) return *std::move(value);
    if (node.fact == Fact::age && scope_->ageKey(node.name)) {
      if (base::Diagnostic* d = error(Code::operandsDoNotFit, node,
                                      fmt::format("age({}) is not known before the frame runs", node.name)))
        d->hint =
            "age() may stand in parameters and \"instances\" of passes and in \"let\" used by them, not in "
            "sizes, conditions, repeats or defines";
      return {};
    }
    return unknown(node, fmt::format("{}() of unknown resource '{}'", nameOf(node.fact), node.name),
                   node.name, EvalScope::NameKind::fact_argument, "");
  }

  std::string hintFor(const Value& operand) { return scope_ ? hintForWord(*scope_, operand) : std::string(); }

  Value misfit(const ExprNode& blamed, std::string message, std::string expected, const Value& operand,
               std::string hint = {}) {
    if (base::Diagnostic* d = error(Code::operandsDoNotFit, blamed, std::move(message))) {
      d->expected = std::move(expected);
      d->found = describe(operand);
      d->hint = hint.empty() ? hintFor(operand) : std::move(hint);
    }
    return {};
  }

  bool condition(const Value& operand, const ExprNode& from, const ExprNode& node) {
    if (operand.isNumeric()) return true;
    if (operand.type != Value::Type::none)
      misfit(from, fmt::format("'{}' needs a condition", infoOf(node.op).spelling), "true, false or a number",
             operand);
    return false;
  }

  Value list(const ExprNode& node) {
    Value out;
    out.type = Value::Type::list;
    for (const ExprPtr& child : node.children) {
      const Value item = run(*child);
      if (item.type == Value::Type::none) return {};
      const bool nested = item.type == Value::Type::list;
      if (!item.isNumeric())
        return misfit(*child, "a list holds numbers", "a number", item,
                      nested
                          ? fmt::format("take a part of it, such as 'screen.{0}' or 'size(a).{0}'; or write "
                                        "the whole without brackets around it",
                                        "xyzw"[std::min<std::size_t>(out.count, 3)])
                          : "");
      out.v[out.count++] = item.v[0];
    }
    return out;
  }

  Value component(const ExprNode& node) {
    const Value operand = run(*node.children[0]);
    if (operand.type == Value::Type::none) return {};
    const char name = "xyzw"[node.key];
    if (operand.type != Value::Type::list)
      return misfit(node, fmt::format("'.{}' of something that has no components", name), "a list", operand);
    if (node.key >= operand.count)
      return misfit(node, fmt::format("'.{}' of a list that is too short", name),
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
    if (base::Diagnostic* d =
            error(Code::notAChoice, word,
                  fmt::format("'{}' is not one of the choices of '${}'", found, parameter.name))) {
      for (const std::string& choice : choices) d->expected += (d->expected.empty() ? "" : ", ") + choice;
      d->found = found;
      if (const std::string nearest = base::nearestName(found, choices); !nearest.empty())
        d->hint = fmt::format("did you mean '{}'?", nearest);
    }
    return false;
  }

  Value equality(const ExprNode& node) {
    const Value left = run(*node.children[0]);
    const Value right = run(*node.children[1]);
    if (left.type == Value::Type::none || right.type == Value::Type::none || !choicesFit(node)) return {};
    if (scope_ && diagnostics_ && reportBareWords(node, *scope_, *diagnostics_)) return {};
    const bool comparable = left.isNumeric() ? right.isNumeric()
                            : left.type == Value::Type::list
                                ? right.type == Value::Type::list && left.count == right.count
                                : right.type == Value::Type::symbol;
    if (!comparable) {
      Value odd = left.type == Value::Type::symbol ? left : right;
      if (base::Diagnostic* d = error(Code::operandsDoNotFit, node,
                                      fmt::format("'{}' compares {} with {}", infoOf(node.op).spelling,
                                                  describe(left), describe(right)))) {
        d->expected = "two numbers, two lists of one length, or two words";
        d->hint = hintFor(odd);
      }
      return {};
    }
    const bool same = left.isNumeric()                 ? left.v[0] == right.v[0]
                      : left.type == Value::Type::list ? left.v == right.v
                                                       : left.symbol == right.symbol;
    return Value::boolean(same == (node.op == ExprOp::equal));
  }

  Value order(const ExprNode& node) {
    const Value left = run(*node.children[0]);
    const Value right = run(*node.children[1]);
    if (left.type == Value::Type::none || right.type == Value::Type::none) return {};
    for (const int side : {0, 1}) {
      const Value& operand = side == 0 ? left : right;
      if (!operand.isNumeric())
        return misfit(
            operand.type == Value::Type::symbol ? *node.children[static_cast<std::size_t>(side)] : node,
            fmt::format("'{}' compares numbers only", infoOf(node.op).spelling), "a number", operand);
    }
    const double a = left.v[0], b = right.v[0];
    switch (node.op) {
      case ExprOp::less:
        return Value::boolean(a < b);
      case ExprOp::less_equal:
        return Value::boolean(a <= b);
      case ExprOp::greater:
        return Value::boolean(a > b);
      default:
        return Value::boolean(a >= b);
    }
  }

  bool arithmeticOperand(const Value& operand, const ExprNode& from, const ExprNode& node) {
    if (operand.isNumeric() || operand.type == Value::Type::list) return true;
    if (operand.type != Value::Type::none)
      misfit(from, fmt::format("'{}' needs numbers", infoOf(node.op).spelling), "a number or a list",
             operand);
    return false;
  }

  Value noResult(const ExprNode& node, const Value& left, const Value& right, bool binary) {
    const char* spelling = infoOf(node.op).spelling;
    const bool divides = node.op == ExprOp::divide || node.op == ExprOp::modulo;
    std::string message = fmt::format("'{}' has no finite result", spelling);
    std::string expected = "a result that a double can hold", hint;
    if (divides &&
        std::find(right.v.begin(), right.v.begin() + right.count, 0.0) != right.v.begin() + right.count) {
      message = fmt::format("'{}' divides by zero", spelling);
      expected = "a divisor that is not zero";
      hint = "guard it: 'b == 0 ? 0 : a / b'";
    } else if (node.op == ExprOp::log2ceil) {
      message = fmt::format("log2ceil() of {}, which is not above zero", toText(left));
      expected = "a number above zero";
      hint = "guard it: 'n > 0 ? log2ceil(n) : 0'";
    }
    if (base::Diagnostic* d = error(Code::noFiniteResult, node, std::move(message))) {
      d->expected = std::move(expected);
      d->found = binary ? fmt::format("{} {} {}", toText(left), spelling, toText(right))
                        : fmt::format("{}({})", spelling, toText(left));
      d->hint = std::move(hint);
    }
    return {};
  }

  Value apply(const ExprNode& node, const Value& left, const Value& right, bool binary) {
    Value out;
    const bool lists = left.type == Value::Type::list || right.type == Value::Type::list;
    if (left.type == Value::Type::list && right.type == Value::Type::list && left.count != right.count) {
      if (base::Diagnostic* d =
              error(Code::operandsDoNotFit, node,
                    fmt::format("'{}' of two lists that differ in length", infoOf(node.op).spelling))) {
        d->expected = fmt::format("a list of {}", left.count);
        d->found = fmt::format("a list of {}", right.count);
      }
      return {};
    }
    out.type = lists ? Value::Type::list : Value::Type::number;
    out.count = std::max(left.count, right.count);
    if (left.type == Value::Type::list) out.count = left.count;
    if (right.type == Value::Type::list) out.count = right.count;
    for (std::size_t i = 0; i < out.count; ++i) {
      const double a = left.v[left.type == Value::Type::list ? i : 0];
      const double b = right.v[right.type == Value::Type::list ? i : 0];
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
  base::Diagnostics* diagnostics_ = nullptr;
};

bool checkNode(const ExprNode& node, EvalScope& scope, base::Diagnostics& diagnostics) {
  Evaluator evaluator(scope, diagnostics);
  const std::size_t before = diagnostics.errorCount();
  if (node.op == ExprOp::variable) evaluator.variable(node);
  if (node.op == ExprOp::builtin) evaluator.builtin(node);
  if (node.op == ExprOp::equal || node.op == ExprOp::not_equal) evaluator.choicesFit(node);
  for (const ExprPtr& child : node.children) checkNode(*child, scope, diagnostics);
  return diagnostics.errorCount() == before;
}

}  // namespace

Value evaluateNode(const ExprNode& node, EvalScope& scope, base::Diagnostics& diagnostics) {
  return Evaluator(scope, diagnostics).run(node);
}

Value evaluateNode(const ExprNode& node, const AgeFunction& age, std::span<const Value> parameters,
                   base::Diagnostics* diagnostics) {
  return Evaluator(age, parameters, diagnostics).run(node);
}

Value Expr::evaluate(EvalScope& scope, base::Diagnostics& diagnostics) const {
  return root_ ? Evaluator(scope, diagnostics).run(*root_) : Value{};
}

bool Expr::check(EvalScope& scope, base::Diagnostics& diagnostics) const {
  return !root_ || checkNode(*root_, scope, diagnostics);
}

Value Expr::evaluateFolded(const std::function<double(std::uint32_t key)>& age,
                           std::span<const Value> parameters) const {
  return root_ ? evaluateNode(*root_, age, parameters, nullptr) : Value{};
}

}  // namespace weft::graph
