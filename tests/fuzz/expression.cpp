// Expressions, and values as a person types them.
#include <optional>

#include "engine/graph/language/expr.h"
#include "tests/fuzz/fuzz.h"
#include "tests/graph/language/expr_text.h"

namespace weft::fuzz {

namespace {

// Knows every name: the first letter says what it is.
class AnyScope : public graph::EvalScope {
  std::optional<graph::Value> variable(std::string_view name) override {
    const char first = name.empty() ? 'x' : name.front();
    if (first < 'e') return graph::Value::boolean(first == 'b');
    if (first < 'h') return graph::Value::text("word");
    if (first < 'k') return graph::Value{graph::Value::Type::list, 3, {1, 2, 3, 0}, {}};
    return graph::Value::number(first - 'n');
  }
  std::optional<graph::Value> index(std::string_view name) override { return variable(name); }
  std::optional<graph::Value> builtin(std::string_view name) override { return variable(name); }
  std::optional<graph::Value> fact(graph::Fact, std::string_view name, std::uint32_t,
                                   const text::Place&) override {
    return variable(name);
  }
  std::optional<std::uint32_t> ageKey(std::string_view) override { return 0; }
  std::optional<std::shared_ptr<const graph::ExprNode>> folded(std::string_view name,
                                                               const text::Place& place) override {
    return name.starts_with("l") ? std::optional(graph::Expr::parameter(0, place).tree()) : std::nullopt;
  }
};

}  // namespace

void fuzz(std::string_view input) {
  const graph::Value value = graph::parseValue(input);
  if (value.isNumeric() || value.type == graph::Value::Type::list)
    expect(graph::parseValue(graph::toText(value)) == value, "a value that is written as it is read");
  text::Diagnostics said;
  const auto parsed = graph::Expr::parse(input, {"x.json", 1, 1}, said);
  expectAnswer(parsed.has_value(), said);
  if (!parsed) return;
  const std::string text = textOf(*parsed);
  const auto again = graph::Expr::parse(text, {"x.json", 1, 1}, said);
  expect(again && textOf(*again) == text, "an expression that is written as it is read", said);
  AnyScope scope;
  parsed->check(scope, said);
  parsed->evaluate(scope, said);
  const graph::Expr folded = parsed->fold(scope, said);
  const graph::Value parameters[] = {graph::Value::number(2)};
  if (folded.present()) folded.evaluateFolded([](std::uint32_t) { return 0.5; }, parameters, &said);
  expectAnswer(true, said);
}

}  // namespace weft::fuzz
