// The grammar of docs/graph-format.md: one token of lookahead and precedence climbing. Stops at
// the first error of an expression; recursion is bounded by kMaxNesting and the height of the tree by
// kMaxParsedHeight. Declared in expr.h and expr_node.h.
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "engine/graph/language/expr.h"
#include "engine/graph/language/expr_node.h"
#include "engine/graph/language/names.h"
#include "engine/text/words/words.h"
#include "graph_sentences.h"

namespace weft::graph {

namespace {

// ---- tokens: numbers, identifiers, operators ----

struct Token {
  enum class Kind : std::uint8_t { end, number, identifier, punctuation, bad };
  Kind kind = Kind::end;
  std::size_t begin = 0;
  std::string_view text;
  double number = 0;
};

// The token at or after `from`, spaces left out; of kind `end` behind the last. A number that a double cannot hold is `bad`; what is
// no token of the language is punctuation that no grammar accepts. Never cuts a UTF-8 sequence in half.
Token scanToken(std::string_view text, std::size_t from) {
  while (from < text.size() && isSpace(text[from])) ++from;
  Token token;
  token.begin = from;
  if (from >= text.size()) return token;
  const char c = text[from];
  std::size_t end = from + 1;
  if (isDigit(c)) {
    const auto result = std::from_chars(text.data() + from, text.data() + text.size(), token.number);
    end = static_cast<std::size_t>(result.ptr - text.data());
    token.kind = Token::Kind::number;
    if (result.ec != std::errc() || !std::isfinite(token.number)) token.kind = Token::Kind::bad;
  } else if (isIdentStart(c)) {
    while (end < text.size() && isIdentChar(text[end])) ++end;
    token.kind = Token::Kind::identifier;
  } else {
    token.kind = Token::Kind::punctuation;
    const std::string_view two = text.substr(from, 2);
    if (two == "||" || two == "&&" || two == "==" || two == "!=" || two == "<=" || two == ">=") ++end;
    while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) ++end;
  }
  token.text = text.substr(from, end - from);
  return token;
}

// ---- the grammar ----

constexpr int kMaxNesting = 64;
constexpr std::size_t kMaxItems = 4, kMaxArguments = 8;
constexpr int kMaxParsedHeight =
    kMaxExprHeight - 1;  // leaves one level for the list that Expr::listOf puts around it
constexpr std::uint32_t kMaxParsedTerms = 1000;

constexpr std::array kFacts = {Fact::size, Fact::mips, Fact::count,
                               Fact::has,  Fact::age,  Fact::format};  // functions

constexpr int kComparison = 4;

class Parser {
 public:
  Parser(std::string_view text, const text::Place& place, text::Diagnostics& diagnostics)
      : text_(text), place_(place), diagnostics_(diagnostics) {
    advance();
  }

  ExprPtr parseWhole() {
    if (token_.kind == Token::Kind::end) return fail(say::emptyExpression, token_);
    ExprPtr root = parseConditional();
    if (root && token_.kind != Token::Kind::end) return failUnexpected("the end of the expression");
    return root;
  }

 private:
  text::Place placeOf(const Token& token) const { return place_.after(token.begin); }

  template <class... Args>
  ExprPtr fail(text::Saying<Args...> what, const Token& token, Args&&... args) {
    diagnostics_.error<Args...>(what, placeOf(token), std::forward<Args>(args)...).found =
        fmt::format("\"{}\"", text_);
    return nullptr;
  }

  ExprPtr failUnexpected(const char* expected) {
    if (std::string hint = text::hintForSpelling(text_); !hint.empty()) {
      diagnostics_.error(say::noValue, place_, text_, hint);
      return nullptr;
    }
    if (token_.kind == Token::Kind::end) return fail(say::expressionEnds, token_, expected);
    return fail(say::unexpectedToken, token_, token_.text, expected,
                text::hintForForeign("expression", token_.text));
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
    if (heightOver(children) > kMaxParsedHeight || termsOver(children) > kMaxParsedTerms)
      return fail(say::expressionTooLong, blamed, kMaxParsedHeight - 1, kMaxParsedTerms);
    return makeNode(op, placeOf(blamed), std::move(children));
  }

  // One level deeper while `parse` runs; an error where that is too deep.
  template <class Parse>
  ExprPtr nested(const Parse& parse) {
    if (depth_ == kMaxNesting) return fail(say::expressionTooDeep, token_, kMaxNesting);
    ++depth_;
    ExprPtr inner = parse();
    --depth_;
    return inner;
  }

  ExprPtr parseConditional() {
    return nested([&] { return parseWithin(); });
  }
  ExprPtr parseWithin() {
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

  // The infix operator at hand; `constant` for anything else.
  ExprOp infixAt() const {
    return token_.kind == Token::Kind::punctuation ? findOp(token_.text, ExprOp::add, ExprOp::logical_or)
                                                   : ExprOp::constant;
  }

  ExprPtr parseInfix(int least) {
    ExprPtr left = parseUnary();
    while (left) {
      const ExprOp infix = infixAt();
      const int precedence = infoOf(infix).precedence;
      if (precedence == 0 || precedence < least) return left;
      const Token blamed = token_;
      advance();
      ExprPtr right = parseInfix(precedence + 1);
      if (!right) return nullptr;
      left = build(infix, blamed, {left, right});
      if (left && precedence == kComparison && infoOf(infixAt()).precedence == kComparison)
        return fail(say::comparisonsDoNotChain, token_, token_.text);
    }
    return left;
  }

  ExprPtr parseUnary() {
    if (!at("-") && !at("!")) return parsePostfix();
    const Token blamed = token_;
    advance();
    ExprPtr operand = nested([&] { return parseUnary(); });
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
    if (first.kind == Token::Kind::bad) return fail(say::numberTooLarge, first, first.text);
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
    if (at("@")) return parseImportValue();
    return failUnexpected("a value");
  }

  // "@" name [ "[" row "]" ] "." value
  ExprPtr parseImportValue() {
    const Token at = token_;
    advance();
    auto node = std::make_shared<ExprNode>();
    std::string name;
    if (token_.kind != Token::Kind::identifier) return failUnexpected("the name of an import");
    node->key = static_cast<std::uint32_t>(token_.begin - at.begin);
    if (!parseDotted(name, true)) return nullptr;
    std::size_t dot = name.rfind('.');
    if (accept("[")) {
      ExprPtr row = parseConditional();
      if (!row) return nullptr;
      if (!accept("]")) return failUnexpected("']'");
      setChildren(*node, {row});
      if (!accept(".") || token_.kind != Token::Kind::identifier)
        return failUnexpected("'.' and the name of a value");
      dot = name.size();
      name += fmt::format(".{}", token_.text);
      advance();
    }
    if (dot == std::string::npos) return fail(say::importIsNoValue, at, name);
    node->op = ExprOp::fact;
    node->fact = Fact::value;
    node->watched = true;
    node->place = placeOf(at);
    node->name = "@" + name.substr(0, dot);
    node->value = Value::text(name.substr(dot + 1));
    return node;
  }

  ExprPtr parseList() {
    const Token bracket = token_;
    advance();
    std::vector<ExprPtr> items;
    do {
      const Token itemStart = token_;
      ExprPtr item = parseConditional();
      if (!item) return nullptr;
      if (item->op == ExprOp::list) return fail(say::listInList, itemStart);
      if (items.size() == kMaxItems) return fail(say::listTooLong, bracket, kMaxItems);
      items.push_back(std::move(item));
    } while (accept(","));
    if (!accept("]")) return failUnexpected("',' or ']'");
    return build(ExprOp::list, bracket, std::move(items));
  }

  ExprPtr parseVariable() {
    const Token dollar = token_;
    advance();
    if (token_.kind != Token::Kind::identifier || token_.begin != dollar.begin + 1)
      return fail(say::dollarWithoutName, dollar);
    std::string name;
    if (!parseDotted(name, true)) return nullptr;
    auto node = std::make_shared<ExprNode>();
    node->op = ExprOp::variable;
    node->place = placeOf(dollar);
    node->name = std::move(name);
    return node;
  }

  // ident { "." ident }, leaving a trailing .x .y .z .w alone when `components`, and .mip when `level`.
  bool parseDotted(std::string& name, bool components, bool level = false) {
    name = token_.text;
    advance();
    while (at(".")) {
      const Token next = peek();
      if (next.kind != Token::Kind::identifier) return advance(), failUnexpected("a name"), false;
      if (componentIndex(next.text) >= 0) {
        if (components) return true;
        return fail(say::componentInName, next, next.text), false;
      }
      if (level && next.text == "mip") return true;
      if (isReservedWord(next.text)) return fail(say::selectorInName, next, next.text, name), false;
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
    const std::size_t begin = token_.begin;
    std::string rest;
    if (!parseDotted(rest, false, fact == Fact::size)) return nullptr;
    ExprPtr level;
    if (accept(".")) {
      advance();  // mip
      if (!accept("[")) return failUnexpected("'[' and a level");
      level = parseConditional();
      if (!level) return nullptr;
      if (!accept("]")) return failUnexpected("']'");
    }
    if (at("[")) return fail(say::selectorInCall, token_, word.text);
    if (!accept(")")) return failUnexpected("')'");
    auto node = std::make_shared<ExprNode>();
    node->op = ExprOp::fact;
    node->fact = fact;
    if (level) setChildren(*node, {level});
    node->dynamic = node->dynamic || fact == Fact::age;
    node->key = static_cast<std::uint32_t>(begin - word.begin);
    node->place = placeOf(word);
    node->name = name + rest;
    return node;
  }

  ExprPtr parseCall(const Token& word) {
    advance();  // (
    for (const Fact fact : kFacts)
      if (word.text == nameOf(fact)) return parseFact(fact, word);
    const ExprOp function = findOp(word.text, ExprOp::minimum, kLastOp);
    const OpInfo info = infoOf(function);
    if (function == ExprOp::constant) {
      std::vector<std::string> known;
      for (const Fact fact : kFacts) known.emplace_back(nameOf(fact));
      for (auto op = ExprOp::minimum; op <= kLastOp; op = static_cast<ExprOp>(static_cast<int>(op) + 1))
        known.emplace_back(infoOf(op).spelling);
      diagnostics_.error(say::unknownFunction, placeOf(word), word.text,
                         text::hintOrNearest("expression", word.text, known));
      return nullptr;
    }
    std::vector<ExprPtr> arguments;
    if (!at(")")) {
      do {
        ExprPtr argument = parseConditional();
        if (!argument) return nullptr;
        if (arguments.size() == kMaxArguments)
          return fail(say::tooManyArguments, word, word.text, kMaxArguments);
        arguments.push_back(std::move(argument));
      } while (accept(","));
    }
    if (!accept(")")) return failUnexpected("',' or ')'");
    if (arguments.size() < info.least || arguments.size() > info.most) {
      diagnostics_.error(say::wrongNumberOfArguments, placeOf(word), word.text,
                         info.least == info.most ? fmt::format("{}", info.least)
                                                 : fmt::format("{} to {}", info.least, info.most),
                         arguments.size());
      return nullptr;
    }
    return build(function, word, std::move(arguments));
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
      if (!accept(".") || token_.kind != Token::Kind::identifier)
        return failUnexpected("a name behind 'device.'");
      node->op = ExprOp::builtin;
      node->name = fmt::format("device.{}", token_.text);
      advance();
      return node;
    }
    if (node->op == ExprOp::identifier && at(".")) {
      const Token next = peek();
      std::string hint = text::hintForForeign("value", fmt::format("{}.{}", word.text, next.text));
      if (hint.empty())
        hint =
            fmt::format("ask size({0}), mips({0}) or count({0}), with .x and .y; '${0}.{1}' is a parameter",
                        word.text, next.text);
      if (next.kind == Token::Kind::identifier && componentIndex(next.text) < 0)
        return fail(say::dottedNoValue, word, word.text, next.text, hint);
    }
    return node;
  }

  std::string_view text_;
  text::Place place_;
  text::Diagnostics& diagnostics_;
  Token token_;
  int depth_ = 0;
};

}  // namespace

ExprPtr parseExprTree(std::string_view text, const text::Place& place, text::Diagnostics& diagnostics) {
  return Parser(text, place, diagnostics).parseWhole();
}

}  // namespace weft::graph
