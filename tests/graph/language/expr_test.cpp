#include "engine/graph/language/expr.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/graph/allocation_count.h"
#include "tests/graph/expand/map_scope.h"
#include "tests/graph/language/expr_text.h"

using namespace weft::graph;
using weft::text::Code;
using weft::text::Diagnostics;
using weft::text::Place;

namespace {

Place placeAt(std::uint32_t column) {
  return {"t.json", 3, column};
}

Value list(std::initializer_list<double> items) {
  Value value;
  value.type = Value::Type::list;
  for (const double item : items) value.v[value.count++] = item;
  return value;
}

MapScope makeScope() {
  MapScope scope;
  scope.variables = {{"n", Value::number(100)},
                     {"levels", Value::number(7)},
                     {"bloom", Value::boolean(true)},
                     {"draw", Value::text("billboard")},
                     {"tiles", list({80, 45})},
                     {"grid", list({21, 21, 3})},
                     {"composite.fog", Value::boolean(false)},
                     {"software", Value::boolean(false)}};
  scope.choices = {{"draw", {"billboard", "icosphere"}}};
  scope.indices = {{"i", Value::number(1)}, {"k", Value::number(3)}};
  scope.builtins = {{"screen", list({1280, 720})}, {"device.software", Value::boolean(true)}};
  scope.facts = {{{Fact::size, "hdr"}, list({1280, 720})},
                 {{Fact::mips, "glow"}, Value::number(6)},
                 {{Fact::count, "@spheres"}, Value::number(100)},
                 {{Fact::has, "sun"}, Value::boolean(false)},
                 {{Fact::size, "ibl.environment"}, list({1024, 512})}};
  scope.ageKeys = {{"ibl.specular", 4}, {"mean", 9}};
  return scope;
}

// The canonical text of the value of `text`, or the formatted diagnostics.
std::string eval(std::string_view text) {
  MapScope scope = makeScope();
  Diagnostics diagnostics;
  const auto expr = Expr::parse(text, placeAt(10), diagnostics);
  if (!expr) return diagnostics.text();
  const Value value = expr->evaluate(scope, diagnostics);
  if (!diagnostics.empty()) {
    CHECK(value.type == Value::Type::none);
    return diagnostics.text();
  }
  // What is printed reads back as the same value.
  Diagnostics again;
  const auto copy = Expr::parse(textOf(*expr), placeAt(10), again);
  REQUIRE_MESSAGE(copy, textOf(*expr));
  CHECK_MESSAGE(copy->evaluate(scope, again) == value, textOf(*expr));
  CHECK(textOf(*copy) == textOf(*expr));
  return toText(value);
}

struct Failure {
  Code code{};
  std::uint32_t column = 0;
  std::string hint;
  std::string message;
};

// The only diagnostic of `text`; its column counts from 1 at the first character of the text.
Failure failure(std::string_view text) {
  MapScope scope = makeScope();
  Diagnostics diagnostics;
  if (const auto expr = Expr::parse(text, placeAt(1), diagnostics)) {
    const Value value = expr->evaluate(scope, diagnostics);
    if (!diagnostics.contains(Code::unknownVariable)) CHECK(value.type == Value::Type::none);
  }
  REQUIRE_MESSAGE(diagnostics.size() == 1, std::string(text), "\n", diagnostics.text());
  const auto& d = diagnostics.items()[0];
  return {d.code, d.place.column, d.hint, d.message};
}

}  // namespace

TEST_CASE("arithmetic, precedence, lists and broadcast") {
  CHECK(eval("1 + 2 * 3") == "7");
  CHECK(eval("(1 + 2) * 3") == "9");
  CHECK(eval("10 - 4 - 3") == "3");
  CHECK(eval("10 - (4 - 3)") == "9");
  CHECK(eval("2 * (3 / (4 / 2))") == "3");
  CHECK(eval("-2 * -3") == "6");
  CHECK(eval("- - 2") == "2");
  CHECK(eval("1e3 + 0.5") == "1000.5");
  CHECK(eval("7 % 3") == "1");
  CHECK(eval("-1 % 3") == "2");  // floored, as in GLSL
  CHECK(eval("screen/2") == "[640, 360]");
  CHECK(eval("ceil(size(hdr)/16)") == "[80, 45]");
  CHECK(eval("[1, size(ibl.environment).y]") == "[1, 512]");
  CHECK(eval("$tiles.x * $tiles.y * 4 * 257") == "3700800");
  CHECK(eval("$grid.x * $grid.y * $grid.z") == "1323");
  CHECK(eval("[1, 2] + [10, 20]") == "[11, 22]");
  CHECK(eval("2 - [1, 2]") == "[1, 0]");
  CHECK(eval("-[1, 2]") == "[-1, -2]");
  CHECK(eval("([1, 2] * 3).y") == "6");
  CHECK(eval("[1, 2, 3, 4].w") == "4");
  CHECK(eval("min([4, 9], 6)") == "[4, 6]");
  CHECK(eval("max(1, 5, 3)") == "5");
  CHECK(eval("abs(-3) + floor(1.7)") == "4");
}

TEST_CASE("log2ceil and pow2ceil are exact") {
  CHECK(eval("log2ceil(1)") == "0");
  CHECK(eval("log2ceil(2)") == "1");
  CHECK(eval("log2ceil(3)") == "2");
  CHECK(eval("log2ceil($n)") == "7");
  CHECK(eval("log2ceil(1048576)") == "20");
  CHECK(eval("log2ceil(1048577)") == "21");
  CHECK(eval("log2ceil(0.3)") == "0");
  CHECK(eval("pow2ceil(0)") == "1");
  CHECK(eval("pow2ceil(5)") == "8");
  CHECK(eval("pow2ceil(8)") == "8");
  CHECK(eval("8 * pow2ceil($n)") == "1024");
}

TEST_CASE("signs print without parentheses, which would nest deeper; a member of a number has them") {
  const auto print = [](const std::string& text) {
    Diagnostics diagnostics;
    const auto expr = Expr::parse(text, placeAt(10), diagnostics);
    return expr ? textOf(*expr) : diagnostics.text();
  };
  for (const std::string& text : {std::string(60, '-') + "$x", std::string(60, '!') + "$x"})
    CHECK(print(text) == text);
  CHECK(print("-(-$x)") == "--$x");
  CHECK(print("7 .z") == "(7).z");
  CHECK(print("(7).z") == "(7).z");
}

TEST_CASE("round, pow2 and log2 take any number, lists item by item") {
  CHECK(eval("round([2.5, -2.5, 2.4])") == "[3, -3, 2]");
  CHECK(eval("pow2([0, 10, -1])") == "[1, 1024, 0.5]");
  CHECK(eval("pow2(0.5) * pow2(0.5) - 2 < 1e-12") == "true");
  CHECK(eval("log2([1, 0.125, 1024])") == "[0, -3, 10]");
  CHECK(eval("pow2(log2(9) / 2)") == "3");
  CHECK(failure("log2(0)").code == Code::noFiniteResult);
  CHECK(failure("pow2(5000)").code == Code::noFiniteResult);
}

TEST_CASE("the size of a level") {
  CHECK(eval("size(hdr.mip[0])") == "[1280, 720]");
  CHECK(eval("size(hdr.mip[k - i])") == "[320, 180]");
  CHECK(eval("size(ibl.environment.mip[1]).x") == "512");
  CHECK(failure("size(hdr.mip[0.5])").code == Code::operandsDoNotFit);
  CHECK(failure("size(hdr.mip[-1])").code == Code::operandsDoNotFit);
  CHECK(failure("size(hdr.mip[0..1])").code == Code::badExpression);
  CHECK(failure("size(hdr.layer[0])").code == Code::badExpression);
  CHECK(failure("mips(hdr.mip[0])").code == Code::badExpression);
}

TEST_CASE("comparison, logic, conditions and symbols") {
  CHECK(eval("$draw == billboard") == "true");
  CHECK(eval("$draw != icosphere") == "true");
  CHECK(eval("$software ? 1 : i == 0 ? 24 : i == 1 ? 8 : 0") == "8");
  CHECK(eval("$bloom ? line : fill") == "line");
  CHECK(eval("(true ? false : true) ? 1 : 2") == "2");
  CHECK(eval("!$bloom || k-1 >= 2 && true") == "true");
  CHECK(eval("true || true && false") == "true");
  CHECK(eval("(true || true) && false") == "false");
  CHECK(eval("!(1 < 2)") == "false");
  CHECK(eval("(1 < 2) == true") == "true");
  CHECK(eval("[1, 2] == [1, 2]") == "true");
  CHECK(eval("device.software") == "true");
  CHECK(eval("$composite.fog") == "false");
  CHECK(eval("billboard") == "billboard");
  CHECK(eval("count(@spheres) / mips(glow)") == "16.666666666666668");
}

TEST_CASE("branches that are not taken are not evaluated") {
  MapScope scope = makeScope();
  Diagnostics diagnostics;
  const auto expr =
      Expr::parse("has(sun) && size(sun).x > 1 ? 1/0 : has(sun) || true ? 4 : 1/0", placeAt(1), diagnostics);
  REQUIRE(expr);
  CHECK(expr->evaluate(scope, diagnostics) == Value::number(4));
  CHECK(scope.factsAsked == 2);
  CHECK(diagnostics.empty());
}

TEST_CASE("syntax errors point at the offending token") {
  CHECK(failure("").code == Code::badExpression);
  CHECK(failure("1 +").column == 4);
  CHECK(failure("1 + * 2").column == 5);
  CHECK(failure("(1 + 2").column == 7);
  CHECK(failure("1 2").column == 3);
  CHECK(failure("$").column == 1);
  CHECK(failure("$ bloom").column == 1);
  CHECK(failure("$a ? 1").column == 7);
  CHECK(failure("1 < 2 < 3").column == 7);
  CHECK(failure("1 = 2").hint == "write '==', '<=' or '>=' to compare");
  CHECK(failure("true and false").hint == "write '&&'");
  CHECK(failure("[1, 2").column == 6);
  CHECK(failure("[[1, 2], 3]").column == 2);
  CHECK(failure("[1, 2, 3, 4, 5]").column == 1);
  CHECK(failure("@spheres").code == Code::badExpression);
  CHECK(failure("1 + ibl.environment").column == 5);
  CHECK(failure("mips(glow.mip[0])").column == 11);
  CHECK(failure("size(hdr.x)").column == 10);
  CHECK(failure("$grid.q").code == Code::unknownVariable);
  CHECK(failure("[1, 2].q").column == 8);
  CHECK(failure("1e999").column == 1);
  CHECK(failure("1 + \xC3\xA9").message == "unexpected '\xC3\xA9' where a value is expected");
  CHECK(failure("celi(1)").code == Code::badFunctionCall);
  CHECK(failure("1 + celi(1)").column == 5);
  CHECK(failure("celi(1)").hint == "did you mean 'ceil'?");
  CHECK(failure("ceil(1, 2)").code == Code::badFunctionCall);
  CHECK(failure("min(1)").code == Code::badFunctionCall);
  CHECK(failure("device").code == Code::badExpression);
}

TEST_CASE("depth is limited, not the stack") {
  const std::string deep(100000, '(');
  CHECK(failure(deep).code == Code::badExpression);
  CHECK(failure(std::string(100000, '-') + "$n").code == Code::badExpression);
  CHECK(failure(std::string(100000, '[')).code == Code::badExpression);
  std::string chain = "$n";
  for (int i = 0; i < 100000; ++i) chain += "+$n";
  CHECK(failure(chain).code == Code::badExpression);
  std::string choice = "$n";
  for (int i = 0; i < 100000; ++i) choice += "?1:$n";
  CHECK(failure(choice).code == Code::badExpression);
  std::string fits = "$n";
  for (int i = 0; i < 150; ++i) fits += "+$n";
  CHECK(eval(fits) == "15100");
}

TEST_CASE("unknown names have the nearest one") {
  CHECK(failure("1 + $blom").code == Code::unknownVariable);
  CHECK(failure("1 + $blom").column == 5);
  CHECK(failure("$blom").hint == "did you mean '$bloom'?");
  CHECK(failure("size(hdrr)").hint == "did you mean 'hdr'?");
  CHECK(failure("device.softwear").hint == "did you mean 'device.software'?");
}

TEST_CASE("types, shapes and domains") {
  CHECK(failure("1 + fill").code == Code::operandsDoNotFit);
  CHECK(failure("1 + fill").column == 5);
  CHECK(failure("1 + bloom").hint == "write '$bloom' for the parameter");
  CHECK(failure("$draw * 2").column == 1);
  CHECK(failure("[1, 2] + [1, 2, 3]").code == Code::operandsDoNotFit);
  CHECK(failure("[1, 2] + [1, 2, 3]").column == 8);
  CHECK(failure("[1, fill]").column == 5);
  CHECK(failure("[1, 2] < 3").code == Code::operandsDoNotFit);
  CHECK(failure("[1, 2] == 3").code == Code::operandsDoNotFit);
  CHECK(failure("[1, 2] ? 3 : 4").column == 1);
  CHECK(failure("fill && true").code == Code::operandsDoNotFit);
  CHECK(failure("$n.x").code == Code::operandsDoNotFit);
  CHECK(failure("$tiles.z").code == Code::operandsDoNotFit);
  CHECK(failure("$n == fill").code == Code::operandsDoNotFit);
  CHECK(failure("1 / 0").code == Code::noFiniteResult);
  CHECK(failure("1 / 0").column == 3);
  CHECK(failure("1 % 0").code == Code::noFiniteResult);
  CHECK(failure("[1, 2] / [1, 0]").code == Code::noFiniteResult);
  CHECK(failure("log2ceil(0)").code == Code::noFiniteResult);
  CHECK(failure("log2ceil(-4)").code == Code::noFiniteResult);
  CHECK(failure("1e308 * 10").code == Code::noFiniteResult);
  CHECK(failure("age(ibl.specular)").code == Code::operandsDoNotFit);  // not before the frame runs
}

TEST_CASE("a choice is compared with its choices only") {
  CHECK(failure("$draw == bilboard").code == Code::notAChoice);
  CHECK(failure("$draw == bilboard").column == 10);
  CHECK(failure("$draw == bilboard").hint == "did you mean 'billboard'?");
  CHECK(failure("line != $draw").code == Code::notAChoice);
}

TEST_CASE("check finds names in branches that are not taken") {
  MapScope scope = makeScope();
  Diagnostics diagnostics;
  const auto expr =
      Expr::parse("has(sun) ? $blom + size(nothing).x : $draw == lines ? 1 : $n", placeAt(1), diagnostics);
  REQUIRE(expr);
  CHECK(!expr->check(scope, diagnostics));
  REQUIRE(diagnostics.size() == 2);
  CHECK(diagnostics.items()[0].code == Code::unknownVariable);
  CHECK(diagnostics.items()[1].code == Code::notAChoice);
  CHECK(scope.factsAsked == 0);
  const auto good = Expr::parse("$n + size(nothing).x", placeAt(1), diagnostics);
  CHECK(good->check(scope, diagnostics));
}

TEST_CASE("a scope that reported its own error silences the rest") {
  MapScope scope = makeScope();
  scope.variables["broken"] = Value{};
  Diagnostics diagnostics;
  for (const char* text : {"$broken + 1", "[$broken, 1]", "$broken ? 1 : 2", "$broken == 1", "!$broken",
                           "$broken.x", "min($broken, 2)"}) {
    const auto expr = Expr::parse(text, placeAt(1), diagnostics);
    REQUIRE(expr);
    CHECK(expr->evaluate(scope, diagnostics).type == Value::Type::none);
  }
  CHECK(diagnostics.empty());
}

TEST_CASE("folding keeps only what changes from frame to frame") {
  MapScope scope = makeScope();
  Diagnostics diagnostics;
  const auto parse = [&](const char* text) { return Expr::parse(text, placeAt(1), diagnostics).value(); };

  const Expr fade = parse("min(age(ibl.specular) / (0.125 * 2), 1) * $n");
  CHECK(fade.dynamic());
  CHECK(fade.variables() == std::vector<std::string>{"n"});
  CHECK(fade.facts() == std::vector<std::pair<Fact, std::string_view>>{{Fact::age, "ibl.specular"}});
  const Expr folded = fade.fold(scope, diagnostics);
  REQUIRE(folded.present());
  CHECK(folded.dynamic());
  CHECK(textOf(folded) == "min(age(#4) / 0.25, 1) * 100");
  const std::function<double(std::uint32_t)> age = [](std::uint32_t key) { return key == 4 ? 0.125 : 0.0; };
  CHECK(folded.evaluateFolded(age) == Value::number(50));
  const std::function<double(std::uint32_t)> never = [](std::uint32_t) {
    return std::numeric_limits<double>::infinity();
  };
  CHECK(folded.evaluateFolded(never) == Value::number(100));

  const Expr fixed = parse("$bloom ? $tiles : age(mean)").fold(scope, diagnostics);
  CHECK(!fixed.dynamic());
  CHECK(fixed.isConstant());
  CHECK(fixed.evaluateFolded(age) == list({80, 45}));
  CHECK(textOf(parse("$bloom || age(mean) > 1").fold(scope, diagnostics)) == "true");
  CHECK(textOf(parse("age(mean) > 1 ? [age(mean), 2] : $tiles").fold(scope, diagnostics)) ==
        "age(#9) > 1 ? [age(#9), 2] : [80, 45]");
  CHECK(diagnostics.empty());

  CHECK(!parse("age(nothing)").fold(scope, diagnostics).present());
  CHECK(diagnostics.items().back().code == Code::unknownVariable);
  CHECK(!parse("[1, 2] + age(mean) + [1, 2, 3]").fold(scope, diagnostics).present());
  CHECK(diagnostics.items().back().code == Code::operandsDoNotFit);
  CHECK(diagnostics.size() == 2);

  const Expr divides = parse("1 / (age(mean) - 1)").fold(scope, diagnostics);
  const std::function<double(std::uint32_t)> one = [](std::uint32_t) { return 1.0; };
  CHECK(divides.evaluateFolded(one) == Value{});
}

TEST_CASE("a let that contains age is folded into its users") {
  MapScope scope = makeScope();
  Diagnostics diagnostics;
  const auto parse = [&](const char* text) { return Expr::parse(text, placeAt(1), diagnostics).value(); };
  scope.foldedLets["fade"] = parse("min(age(mean) / 0.25, 1)").fold(scope, diagnostics);
  scope.foldedLets["fixed"] = parse("$n + 1").fold(scope, diagnostics);
  const Expr user = parse("$fade * $fixed");
  CHECK(!user.dynamic());  // before anyone knows what $fade is
  const Expr folded = user.fold(scope, diagnostics);
  REQUIRE(folded.present());
  CHECK(folded.dynamic());
  CHECK(textOf(folded) == "min(age(#9) / 0.25, 1) * 101");
  const std::function<double(std::uint32_t)> age = [](std::uint32_t) { return 0.125; };
  CHECK(folded.evaluateFolded(age) == Value::number(50.5));
  CHECK(parse("$fixed").fold(scope, diagnostics).isConstant());
  // Folding what is folded changes nothing.
  CHECK(textOf(folded.fold(scope, diagnostics)) == textOf(folded));
  CHECK(diagnostics.empty());
}

TEST_CASE("evaluating a folded expression does not allocate") {
  MapScope scope = makeScope();
  Diagnostics diagnostics;
  const Expr folded =
      Expr::parse("age(mean) > 0.5 && $bloom ? [age(mean), $n, 3] * 2 + min(age(mean), 1) : screen",
                  placeAt(1), diagnostics)
          ->fold(scope, diagnostics);
  REQUIRE(folded.present());
  const std::function<double(std::uint32_t)> age = [](std::uint32_t) { return 0.75; };
  const std::size_t before = allocationCount();
  const Value value = folded.evaluateFolded(age);
  CHECK(allocationCount() == before);
  CHECK(value == list({2.25, 200.75, 6.75}));
}

TEST_CASE("literals and lists made of JSON values") {
  const Expr number = Expr::constant(Value::number(2048), placeAt(4));
  CHECK(number.isConstant());
  CHECK(number.text() == "2048");
  CHECK(number.place().column == 4);
  Diagnostics diagnostics;
  const Expr mixed = Expr::listOf({number, Expr::parse("$n/2", placeAt(9), diagnostics).value()}, placeAt(3));
  CHECK(textOf(mixed) == "[2048, $n / 2]");
  CHECK(mixed.text() == "[2048, $n/2]");  // as the file writes it
  CHECK(Expr::parse(" (false)", placeAt(9), diagnostics).value().text() == "false");
  CHECK(mixed.place().column == 3);
  MapScope scope = makeScope();
  CHECK(mixed.evaluate(scope, diagnostics) == list({2048, 50}));
  CHECK(Expr::listOf({number, number}, placeAt(3)).isConstant());
  CHECK(!Expr().present());
  CHECK(Expr().evaluate(scope, diagnostics).type == Value::Type::none);
  CHECK(Expr::parse("(1 + $n) * 2", placeAt(5), diagnostics)->place().column == 5);
}
