// Expressions of graph files: parsed once into a shared immutable tree, evaluated against a scope.
// The grammar is in docs/graph-format.md. Errors are diagnostics at the expression's place (column of the offending
// token inside the string where known). The scope answers for every name.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/text/diagnostic.h"

namespace weft::graph {

// What an expression yields: a number, a boolean, a list of one to four numbers, or a symbol (a choice such as
// `billboard`, or a path). All numbers are double, and are converted where they are used.
struct Value {
  enum class Type : std::uint8_t { none, number, boolean, list, symbol };
  Type type = Type::none;
  std::uint8_t count = 0;     // components in use: 1 for number and boolean, 1..4 for a list
  std::array<double, 4> v{};  // booleans are 0 or 1
  std::string symbol{};

  static Value number(double x) { return {Type::number, 1, {x, 0, 0, 0}, {}}; }
  static Value boolean(bool b) { return {Type::boolean, 1, {b ? 1.0 : 0.0, 0, 0, 0}, {}}; }
  static Value text(std::string s) { return {Type::symbol, 0, {}, std::move(s)}; }

  bool isNumeric() const { return type == Type::number || type == Type::boolean; }
  bool truth() const { return isNumeric() && v[0] != 0; }
  friend bool operator==(const Value&, const Value&) = default;
};

// "1.5", "true", "[1, 2]", "billboard": canonical, shortest round-trip numbers.
std::string toText(const Value& value);

// A value as a person types it behind --set NAME=: a JSON scalar or a list of one to four numbers, else a word; quotes
// around a word may be left out.
Value parseValue(std::string_view text);
// A finite number, perhaps with blanks around it; else nothing.
std::optional<double> parseNumber(std::string_view text);

struct ExprNode;  // engine/graph/language/expr_node.h
// Seconds since the publication behind a key.
using AgeFunction = std::function<double(std::uint32_t key)>;

// The last is no function: @import.value.
enum class Fact : std::uint8_t { size, mips, count, has, age, format, value };

// "@lamps[0].color": `import` has its @.
constexpr std::uint8_t kWholeValue = 4;
struct ImportValue {
  std::string_view import, value;
  std::uint32_t row = 0;
  std::uint8_t part = kWholeValue;  // or a column of a matrix
};

// Answers for names while an expression is evaluated. nullopt means "no such name"; evaluate() then reports
// it with the nearest of candidates(). A scope that already reported an error of its own returns Value{}
// (type none), which makes the whole result none without a second message.
class EvalScope {
 public:
  enum class NameKind : std::uint8_t { variable, fact_argument, builtin };
  virtual ~EvalScope() = default;
  // $name or $pass.parameter, also `let` names; a bare repeat index; "screen", "device.software", "device.window"; size(resource).
  virtual std::optional<Value> variable(std::string_view) { return std::nullopt; }
  virtual std::optional<Value> index(std::string_view) { return std::nullopt; }
  virtual std::optional<Value> builtin(std::string_view) { return std::nullopt; }
  // `level`: of size(resource.mip[level]), else 0.
  virtual std::optional<Value> fact(Fact, std::string_view /*resource*/, std::uint32_t /*level*/,
                                    const text::Place&) {
    return std::nullopt;
  }
  // The choices of a choice parameter, or empty: `$draw == bilboard` is then an error with the nearest choice.
  virtual std::vector<std::string> choicesOf(std::string_view /*variable*/) { return {}; }
  virtual std::vector<std::string> candidates(NameKind) { return {}; }
  // A key by which a folded age() finds its resource at run time; nullopt for an unknown resource.
  virtual std::optional<std::uint32_t> ageKey(std::string_view /*resource*/) { return std::nullopt; }
  // What fold() puts in the place of a variable that changes without another plan: a live parameter, or a `let` that
  // contains one or age(), perhaps through another `let`, already folded in the scope it stands in (null after a report).
  // nullopt for every other name, which is folded to its value.
  virtual std::optional<std::shared_ptr<const ExprNode>> folded(std::string_view /*variable*/,
                                                                const text::Place&) {
    return std::nullopt;
  }
  // What it is, or a value of its type as long as nothing runs; none after a report.
  virtual Value importValue(const ImportValue&, const text::Place&) { return {}; }
  // A key by which a folded expression finds it, as a live parameter; nullopt while it is folded to importValue().
  virtual std::optional<std::uint32_t> importKey(const ImportValue&) { return std::nullopt; }
  virtual bool keepsImports() const { return false; }
  // What folded expressions ask by these keys: seconds since a publication, the value of a live parameter.
  virtual double age(std::uint32_t) { return 0; }
  virtual Value parameter(std::uint32_t) { return {}; }
};

// Shapes and types are the same at every age; an age that no formula singles out shows them.
constexpr double kTrialAge = 0.61803398874989485;

// A parsed expression, or a literal. Copies share the tree. Default-constructed: absent.
class Expr {
 public:
  Expr() = default;
  static Expr constant(Value value, text::Place place);
  // A folded expression that is the value of one live parameter.
  static Expr parameter(std::uint32_t key, text::Place place);
  static Expr listOf(std::vector<Expr> items, text::Place place);
  // `a && b`; where one of them is absent, or says that it is false, that is all there is to say.
  static Expr both(const Expr& a, const Expr& b);
  // Parses `text`, which stands at `place` (the place of the string's first character after the quote).
  static std::optional<Expr> parse(std::string_view text, const text::Place& place,
                                   text::Diagnostics& diagnostics);

  bool present() const { return root_ != nullptr; }
  // True when it contains age(): its value changes from frame to frame.
  bool dynamic() const;
  // True when it is folded and contains live parameters or values of imports.
  bool live() const;
  // True when it is not folded and contains values of imports.
  bool watched() const;
  // A column of the matrix that the expression is: a value of an import.
  Expr column(std::uint8_t part) const;
  // The keys of those, each once, ascending.
  std::vector<std::uint32_t> parameterKeys() const;
  // As the file writes it, of a literal its value; not of a folded one.
  std::string text() const;
  const text::Place& place() const { return start_; }
  // Every $variable it names, each once (for culling conditions, hot reload and `explain`).
  const std::vector<std::string>& variables() const;
  // The name of the one $variable that is all of it; null when it is something else.
  const std::string* onlyVariable() const;
  // True when the bare `word` stands in it: a repeat index or a choice.
  bool says(std::string_view word) const;
  // Every size(x), mips(x), count(x), has(x), age(x), format(x) it asks, with the name as written (an @ included), in order.
  std::vector<std::pair<Fact, std::string_view>> facts() const;
  // True when evaluating it needs no scope: a literal of the file, or a folded expression without age() and live parameters.
  bool isConstant() const;

  // The value, or type none after an error was reported; a misspelt variable is reported and read as the nearest. age() is an error here unless `scope.fact` answers
  // it. Branches that are not taken (of ?: && ||) are not evaluated.
  Value evaluate(EvalScope& scope, text::Diagnostics& diagnostics) const;
  // Reports names and choices that do not exist, also in branches that evaluate() would not take. Asks the
  // scope for variables and choices only, never for facts. True when it found nothing wrong.
  bool check(EvalScope& scope, text::Diagnostics& diagnostics) const;
  // Everything but age() and live parameters replaced by its value; these carry scope.ageKey(name) and
  // scope.parameterKey(name). Absent after an error was reported.
  Expr fold(EvalScope& scope, text::Diagnostics& diagnostics) const;
  // Evaluates a folded expression; no heap allocation for numbers and lists. `age` gives seconds since
  // publication, which may be infinite; `parameters` the values by their keys. Type none (all components 0)
  // when the result has none, such as a division by zero; then an error, where `diagnostics` are given.
  Value evaluateFolded(const AgeFunction& age, std::span<const Value> parameters = {},
                       text::Diagnostics* diagnostics = nullptr) const;

  const ExprNode* root() const { return root_.get(); }
  const std::shared_ptr<const ExprNode>& tree() const { return root_; }

 private:
  Expr(std::shared_ptr<const ExprNode> root, text::Place start);

  std::shared_ptr<const ExprNode> root_;
  text::Place start_;
  std::string source_;                                         // "" of a literal
  std::shared_ptr<const std::vector<std::string>> variables_;  // null: there are none
};

}  // namespace weft::graph
