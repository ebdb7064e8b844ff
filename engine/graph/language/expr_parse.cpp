// The grammar of docs/graph-format.md: one token of lookahead and precedence climbing. Stops at
// the first error of an expression; recursion is bounded by kMaxNesting and the height of the tree by
// kMaxParsedHeight. Declared in expr_node.h.
#include <fmt/format.h>

#include <array>
#include <utility>

#include "engine/base/nearest.h"
#include "engine/base/words/foreign_words.h"
#include "engine/graph/language/expr_node.h"
#include "engine/graph/language/expr_token.h"
#include "engine/graph/language/names.h"

namespace weft::graph {

namespace {

constexpr int kMaxNesting = 64;
constexpr std::size_t kMostItems =
    64;  // of a list or a call, counted for the message before they are too many
constexpr int kMaxParsedHeight =
    kMaxExprHeight - 1;  // leaves one level for the list that Expr::listOf puts around it

struct Function {
  const char* name;
  ExprOp op;
  std::size_t least, most;
};
constexpr std::array kFunctions = {Function{"min", ExprOp::minimum, 2, 8},
                                   Function{"max", ExprOp::maximum, 2, 8},
                                   Function{"ceil", ExprOp::ceil, 1, 1},
                                   Function{"floor", ExprOp::floor, 1, 1},
                                   Function{"log2ceil", ExprOp::log2ceil, 1, 1},
                                   Function{"pow2ceil", ExprOp::pow2ceil, 1, 1},
                                   Function{"abs", ExprOp::abs, 1, 1}};
constexpr std::array kFacts = {Fact::size, Fact::mips, Fact::count, Fact::has, Fact::age};

struct Infix {
  const char* spelling;
  ExprOp op;
};
constexpr std::array kInfix = {
    Infix{"||", ExprOp::logical_or}, Infix{"&&", ExprOp::logical_and}, Infix{"==", ExprOp::equal},
    Infix{"!=", ExprOp::not_equal},  Infix{"<=", ExprOp::less_equal},  Infix{">=", ExprOp::greater_equal},
    Infix{"<", ExprOp::less},        Infix{">", ExprOp::greater},      Infix{"+", ExprOp::add},
    Infix{"-", ExprOp::subtract},    Infix{"*", ExprOp::multiply},     Infix{"/", ExprOp::divide},
    Infix{"%", ExprOp::modulo}};
constexpr int kComparison = 4;

class Parser {
 public:
  Parser(std::string_view text, const base::Place& place, base::Diagnostics& diagnostics)
      : text_(text), place_(place), diagnostics_(diagnostics) {
    advance();
  }

  ExprPtr parseWhole() {
    if (token_.kind == Token::Kind::end)
      return fail(token_, "the expression is empty", "write a value, such as 1 or $name");
    ExprPtr root = parseConditional();
    if (root && token_.kind != Token::Kind::end) return failUnexpected("the end of the expression");
    return root;
  }

 private:
  base::Place placeOf(const Token& token) const {
    base::Place place = place_;
    if (place.column > 0) place.column += static_cast<std::uint32_t>(token.begin);
    return place;
  }

  ExprPtr fail(const Token& token, std::string message, std::string hint = {}, std::string expected = {}) {
    auto& diagnostic = diagnostics_.error(base::Code::badExpression, placeOf(token), std::move(message));
    diagnostic.found = fmt::format("\"{}\"", text_);
    diagnostic.hint = std::move(hint);
    diagnostic.expected = std::move(expected);
    return nullptr;
  }

  ExprPtr failUnexpected(const char* expected) {
    if (std::string hint = hintForSize(text_); !hint.empty()) {
      auto& d = diagnostics_.error(base::Code::badExpression, place_, fmt::format("'{}' is no value", text_));
      d.expected = "a number, a list or an expression";
      d.hint = std::move(hint);
      return nullptr;
    }
    if (token_.kind == Token::Kind::end)
      return fail(token_, fmt::format("the expression ends where {} is expected", expected), "", expected);
    std::string hint;
    if (token_.text == "and" || token_.text == "&") hint = "write '&&'";
    if (token_.text == "or" || token_.text == "|") hint = "write '||'";
    if (token_.text == "not") hint = "write '!'";
    if (text_.substr(0, token_.begin).ends_with("not ")) hint = "write '!' for 'not'";
    if (token_.text == "'") hint = "words of a choice stand without quotes";
    if (token_.text == "=") hint = "write '==' to compare";
    if (token_.text == "^" || (token_.text == "*" && text_.substr(0, token_.begin).ends_with("*")))
      hint = "there is no power: write 'a * a', or compute it in the shader";
    if (token_.text == "if") hint = "write 'condition ? a : b'";
    if (token_.text == "{") hint = "write '$name' for a parameter, without braces";
    if (token_.text == ":") hint = "a ':' belongs to 'condition ? a : b'";
    return fail(token_, fmt::format("unexpected '{}' where {} is expected", token_.text, expected), hint,
                expected);
  }

  // ---- tokens ----

  void advance() { token_ = peek(); }
  Token peek() const { return scanToken(text_, token_.begin + token_.text.size()); }
  bool at(std::string_view punctuation) const {
    return token_.kind == Token::Kind::punctuation && token_.text == punctuation;
  }
  bool accept(std::string_view punctuation) {
    if (!at(punctuation)) return false;
    advance();
    return true;
  }

  // ---- grammar ----

  ExprPtr build(ExprOp op, const Token& blamed, std::vector<ExprPtr> children) {
    if (heightOver(children) > kMaxParsedHeight)
      return fail(blamed, fmt::format("the expression chains more than {} operators", kMaxParsedHeight - 1),
                  "split it with \"let\"");
    return makeNode(op, placeOf(blamed), std::move(children));
  }

  class Nesting {
   public:
    explicit Nesting(int& depth) : depth_(depth) { ++depth_; }
    ~Nesting() { --depth_; }
    Nesting(const Nesting&) = delete;
    Nesting& operator=(const Nesting&) = delete;

   private:
    int& depth_;
  };

  ExprPtr parseConditional() {
    const Nesting nesting(depth_);
    if (depth_ > kMaxNesting)
      return fail(token_, fmt::format("the expression is nested more than {} levels deep", kMaxNesting),
                  "split it with \"let\"");
    ExprPtr condition = parseInfix(2);
    if (!condition || !at("?")) return condition;
    const Token mark = token_;
    advance();
    ExprPtr yes = parseConditional();
    if (!yes) return nullptr;
    if (!accept(":")) return failUnexpected("':' of 'condition ? a : b'");
    ExprPtr no = parseConditional();
    if (!no) return nullptr;
    return build(ExprOp::conditional, mark, {condition, yes, no});
  }

  const Infix* infixAt() const {
    if (token_.kind != Token::Kind::punctuation) return nullptr;
    for (const Infix& infix : kInfix)
      if (token_.text == infix.spelling) return &infix;
    return nullptr;
  }

  ExprPtr parseInfix(int least) {
    ExprPtr left = parseUnary();
    while (left) {
      const Infix* infix = infixAt();
      if (!infix || infoOf(infix->op).precedence < least) return left;
      const int precedence = infoOf(infix->op).precedence;
      const Token blamed = token_;
      advance();
      ExprPtr right = parseInfix(precedence + 1);
      if (!right) return nullptr;
      left = build(infix->op, blamed, {left, right});
      if (left && precedence == kComparison && infixAt() && infoOf(infixAt()->op).precedence == kComparison)
        return fail(token_, fmt::format("comparisons do not chain: '{}' follows another one", token_.text),
                    "join two comparisons with '&&'");
    }
    return left;
  }

  ExprPtr parseUnary() {
    if (!at("-") && !at("!")) return parsePostfix();
    const Token blamed = token_;
    const Nesting nesting(depth_);
    if (depth_ > kMaxNesting)
      return fail(token_, fmt::format("the expression is nested more than {} levels deep", kMaxNesting));
    advance();
    ExprPtr operand = parseUnary();
    if (!operand) return nullptr;
    const bool literal = operand->op == ExprOp::constant && operand->value.type == Value::Type::number;
    if (blamed.text == "-" && literal)
      return makeConstant(Value::number(-operand->value.v[0]), placeOf(blamed));
    return build(blamed.text == "-" ? ExprOp::negate : ExprOp::logical_not, blamed, {operand});
  }

  ExprPtr parsePostfix() {
    ExprPtr value = parsePrimary();
    while (value && at(".")) {
      advance();
      const int component = token_.kind == Token::Kind::identifier ? componentIndex(token_.text) : -1;
      if (component < 0) return failUnexpected("one of x, y, z and w");
      const Token blamed = token_;
      advance();
      value = build(ExprOp::component, blamed, {value});
      if (!value) return nullptr;
      auto node = std::make_shared<ExprNode>(*value);
      node->key = static_cast<std::uint32_t>(component);
      value = node;
    }
    return value;
  }

  ExprPtr parsePrimary() {
    const Token first = token_;
    if (first.kind == Token::Kind::bad)
      return fail(first, fmt::format("the number '{}' is out of range", first.text),
                  "use a value a double can hold");
    if (first.kind == Token::Kind::number) {
      advance();
      return makeConstant(Value::number(first.number), placeOf(first));
    }
    if (first.kind == Token::Kind::identifier) return parseWord();
    if (at("$")) return parseVariable();
    if (at("[")) return parseList();
    if (accept("(")) {
      ExprPtr inner = parseConditional();
      if (!inner) return nullptr;
      if (!accept(")")) return failUnexpected("')'");
      return inner;
    }
    if (at("@"))
      return fail(first, "'@' names an import, which is no value by itself",
                  "ask about it with count(@name), size(@name), has(@name)");
    return failUnexpected("a value");
  }

  ExprPtr parseList() {
    const Token bracket = token_;
    advance();
    std::vector<ExprPtr> items;
    do {
      const Token itemStart = token_;
      ExprPtr item = parseConditional();
      if (!item) return nullptr;
      if (item->op == ExprOp::list) return fail(itemStart, "a list holds numbers, not lists");
      if (items.size() == kMostItems)
        return fail(bracket, fmt::format("a list of more than {} items: at most 4 are allowed", kMostItems));
      items.push_back(std::move(item));
    } while (accept(","));
    if (!accept("]")) return failUnexpected("',' or ']'");
    if (items.size() > 4)
      return fail(bracket, fmt::format("a list of {} items: at most 4 are allowed", items.size()));
    return build(ExprOp::list, bracket, std::move(items));
  }

  ExprPtr parseVariable() {
    const Token dollar = token_;
    advance();
    if (token_.kind != Token::Kind::identifier || token_.begin != dollar.begin + 1)
      return fail(dollar, "'$' stands without a name",
                  "write '$name', as in \"parameters\" or \"let\", without braces");
    std::string name;
    if (!parseDotted(name, true)) return nullptr;
    auto node = std::make_shared<ExprNode>();
    node->op = ExprOp::variable;
    node->place = placeOf(dollar);
    node->name = std::move(name);
    return node;
  }

  // ident { "." ident }, leaving a trailing .x .y .z .w alone when `components`.
  bool parseDotted(std::string& name, bool components) {
    name = token_.text;
    advance();
    while (at(".")) {
      const Token next = peek();
      if (next.kind != Token::Kind::identifier) return advance(), failUnexpected("a name"), false;
      if (componentIndex(next.text) >= 0) {
        if (components) return true;
        return fail(next, fmt::format("'.{}' is no part of a name", next.text), "put it behind the ')'"),
               false;
      }
      if (isReservedWord(next.text))
        return fail(next, fmt::format("'.{}' selects a sub-resource, where a name is expected", next.text),
                    hintForPart(name)),
               false;
      advance();
      name += '.';
      name += token_.text;
      advance();
    }
    return true;
  }

  ExprPtr parseFact(Fact fact, const Token& word) {
    std::string name;
    if (accept("@")) name = "@";
    if (token_.kind != Token::Kind::identifier) return failUnexpected("the name of a resource");
    std::string rest;
    if (!parseDotted(rest, false)) return nullptr;
    if (at("["))
      return fail(token_, fmt::format("{}() takes a whole resource, without a selector", word.text));
    if (!accept(")")) return failUnexpected("')'");
    auto node = std::make_shared<ExprNode>();
    node->op = ExprOp::fact;
    node->fact = fact;
    node->dynamic = fact == Fact::age;
    node->place = placeOf(word);
    node->name = name + rest;
    return node;
  }

  ExprPtr parseCall(const Token& word) {
    advance();  // (
    for (const Fact fact : kFacts)
      if (word.text == nameOf(fact)) return parseFact(fact, word);
    const Function* function = nullptr;
    std::vector<std::string> known;
    for (const Fact fact : kFacts) known.emplace_back(nameOf(fact));
    for (const Function& f : kFunctions) {
      known.emplace_back(f.name);
      if (word.text == f.name) function = &f;
    }
    if (!function) {
      auto& d = diagnostics_.error(base::Code::badFunctionCall, placeOf(word),
                                   fmt::format("unknown function '{}'", word.text));
      d.hint = base::hintForForeign(base::Foreign::expression, word.text);
      if (d.hint.empty()) d.hint = base::nearestHint(word.text, known);
      return nullptr;
    }
    std::vector<ExprPtr> arguments;
    if (!at(")")) {
      do {
        ExprPtr argument = parseConditional();
        if (!argument) return nullptr;
        if (arguments.size() == kMostItems)
          return fail(word, fmt::format("{}() with more than {} arguments", word.text, kMostItems));
        arguments.push_back(std::move(argument));
      } while (accept(","));
    }
    if (!accept(")")) return failUnexpected("',' or ')'");
    if (arguments.size() < function->least || arguments.size() > function->most) {
      auto& d = diagnostics_.error(base::Code::badFunctionCall, placeOf(word),
                                   fmt::format("{}() with the wrong number of arguments", word.text));
      d.expected = function->least == function->most
                       ? fmt::format("{}", function->least)
                       : fmt::format("{} to {}", function->least, function->most);
      d.found = fmt::format("{}", arguments.size());
      return nullptr;
    }
    return build(function->op, word, std::move(arguments));
  }

  ExprPtr parseWord() {
    const Token word = token_;
    advance();
    if (word.text == "true" || word.text == "false")
      return makeConstant(Value::boolean(word.text == "true"), placeOf(word));
    if (at("(")) return parseCall(word);
    auto node = std::make_shared<ExprNode>();
    node->place = placeOf(word);
    node->name = word.text;
    node->op = word.text == "screen" ? ExprOp::builtin : ExprOp::identifier;
    if (word.text == "device") {
      if (!accept(".") || token_.kind != Token::Kind::identifier) return failUnexpected("'device.software'");
      node->op = ExprOp::builtin;
      node->name = fmt::format("device.{}", token_.text);
      advance();
      return node;
    }
    if (node->op == ExprOp::identifier && at(".")) {
      const Token next = peek();
      std::string meant = hintForMember(word.text, next.text);
      if (next.kind == Token::Kind::identifier && componentIndex(next.text) < 0)
        return fail(
            word, fmt::format("'{}.{}' is no value", word.text, next.text),
            !meant.empty()
                ? std::move(meant)
                : fmt::format(
                      "'${}.{}' for a parameter, or size(), mips(), count(), has(), age() of a resource",
                      word.text, next.text));
    }
    return node;
  }

  std::string_view text_;
  base::Place place_;
  base::Diagnostics& diagnostics_;
  Token token_;
  int depth_ = 0;
};

}  // namespace

ExprPtr parseExprTree(std::string_view text, const base::Place& place, base::Diagnostics& diagnostics) {
  return Parser(text, place, diagnostics).parseWhole();
}

}  // namespace weft::graph
