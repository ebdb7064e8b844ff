// The grammar of docs/graph-format.md: one token of lookahead and precedence climbing. Stops at
// the first error of an expression; recursion is bounded by kMaxNesting and the height of the tree by
// kMaxParsedHeight. Declared in expr.h and expr_node.h.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "engine/base/nearest.h"
#include "engine/base/words/foreign_words.h"
#include "engine/graph/language/expr.h"
#include "engine/graph/language/expr_node.h"
#include "engine/graph/language/names.h"

namespace weft::graph {

namespace {

// "#ff8000" and "#f80" to "[1, 0.502, 0]": the numbers of the picture file, not linear light. "" for anything else.
std::string hintForColor(std::string_view text) {
  const std::size_t digits = text.empty() || text[0] != '#' ? 0 : text.size() - 1;
  if (digits != 3 && digits != 6 && digits != 8) return {};
  std::string list;
  const std::size_t each = digits == 3 ? 1 : 2;
  for (std::size_t at = 1; at < text.size(); at += each) {
    unsigned value = 0;
    const char* const end = text.data() + at + each;
    const auto [stop, error] = std::from_chars(text.data() + at, end, value, 16);
    if (error != std::errc() || stop != end) return {};
    list += fmt::format("{}{:.3g}", list.empty() ? "" : ", ", value / (each == 1 ? 15.0 : 255.0));
  }
  return fmt::format("a color is a list of numbers, which Weft takes as they are: [{}]", list);
}

// "1920,1080" to "[1920, 1080]".
std::string hintForPair(std::string_view text) {
  double first = 0, second = 0;
  const char* const end = text.data() + text.size();
  const auto comma = std::from_chars(text.data(), end, first);
  if (comma.ec != std::errc() || comma.ptr == end || *comma.ptr != ',') return {};
  const auto last = std::from_chars(comma.ptr + 1, end, second);
  return last.ec == std::errc() && last.ptr == end ? fmt::format("write [{}, {}]", first, second) : "";
}

// "uint[256]" and "256uints" to "256*4": how many bytes that is.
std::string hintForElements(std::string_view text) {
  double count = 0;
  std::string_view type = text;
  if (const std::size_t open = text.find('['); open != std::string_view::npos && text.ends_with(']')) {
    const char* const end = text.data() + text.size() - 1;
    const auto number = std::from_chars(text.data() + open + 1, end, count);
    if (number.ec != std::errc() || number.ptr != end) return {};
    type = text.substr(0, open);
  } else {
    const auto number = std::from_chars(text.data(), text.data() + text.size(), count);
    if (number.ec != std::errc()) return {};
    type.remove_prefix(static_cast<std::size_t>(number.ptr - text.data()));
  }
  if (type.ends_with('s')) type.remove_suffix(1);
  for (const auto& [name, bytes] : {std::pair{"uint", 4}, std::pair{"int", 4}, std::pair{"float", 4},
                                    std::pair{"uvec2", 8}, std::pair{"vec2", 8}, std::pair{"uvec4", 16},
                                    std::pair{"vec4", 16}, std::pair{"uint32", 4}, std::pair{"float32", 4}})
    if (type == name) return fmt::format("sizes of buffers are bytes: write {}*{}", count, bytes);
  return {};
}

}  // namespace

std::string hintForSize(std::string_view whole) {
  if (std::string color = hintForColor(whole); !color.empty()) return color;
  std::string packed(whole);
  std::erase_if(packed, isSpace);
  const std::string_view text = packed;
  if (text == "width,height") return "write 'screen'";
  if (std::string list = hintForPair(text); !list.empty()) return list;
  if (std::string bytes = hintForElements(text); !bytes.empty()) return bytes;
  // "screen*50%", "width/2,height/2", "screen.width"
  if (text.starts_with("screen*") && text.ends_with('%')) {
    double part = 0;
    const auto [at, error] = std::from_chars(text.data() + 7, text.data() + text.size(), part);
    if (error == std::errc() && at + 1 == text.data() + text.size())
      return fmt::format("write 'screen*{}'", part / 100);
  }
  if (text.starts_with("width/")) {
    const std::string_view by = text.substr(6, text.find(',') - std::min<std::size_t>(6, text.size()));
    double part = 0;
    const bool divides =
        std::from_chars(by.data(), by.data() + by.size(), part).ptr == by.data() + by.size() && part > 0;
    if (divides && text == fmt::format("width/{},height/{}", by, by))
      return fmt::format("write 'screen/{}'", by);
  }
  for (const auto& [theirs, ours] : {std::pair{".width", ".x"}, std::pair{".height", ".y"}})
    if (const std::size_t at = text.find(theirs); at != std::string_view::npos)
      return fmt::format("a size has .x and .y: write '{}{}'", text.substr(0, at), ours);
  if (text.ends_with("px") && text.find(',') == std::string_view::npos && !isDigit(text[0]))
    return fmt::format("texels have no unit: write '{}'", text.substr(0, text.size() - 2));
  double first = 0, second = 0;
  const char* const begin = text.data();
  const char* const end = begin + text.size();
  const auto number = std::from_chars(begin, end, first);
  if (number.ec != std::errc() || number.ptr == end) return {};
  const std::string_view rest(number.ptr, static_cast<std::size_t>(end - number.ptr));
  if (rest == "%")
    return fmt::format("write '{}' of what it is a part of: 'screen*{}'", first / 100, first / 100);
  if (rest == "px") return fmt::format("texels have no unit: write {}", first);
  if (rest == "x") return fmt::format("write 'screen*{}'", first);
  for (const std::string_view unit : {"f", "F", "deg", "rad", "s", "ms", "B", "bytes", "texels", "pixels"})
    if (rest == unit) return fmt::format("numbers have no unit and no ending: write {}", first);
  for (const auto& [unit, bytes] :
       {std::pair{"KB", 1024}, std::pair{"KiB", 1024}, std::pair{"MB", 1 << 20}, std::pair{"MiB", 1 << 20}})
    if (rest == unit) return fmt::format("sizes of buffers are bytes: write {}*{}", first, bytes);
  if (rest[0] != 'x' && rest[0] != 'X') return {};
  const auto other = std::from_chars(number.ptr + 1, end, second);
  return other.ec == std::errc() && other.ptr == end ? fmt::format("write [{}, {}]", first, second) : "";
}

namespace {

// What there is in place of a value of "x.mip[i]" and the like.
std::string hintForPart(std::string_view name) {
  return fmt::format(
      "values know the whole: size({0}) is that of level 0, count({0}) and mips({0}) say how many; "
      "\"threads\" left "
      "out is the size of the level that the pass writes, and a shader asks textureSize() or imageSize()",
      name);
}

// What "scene.width" and the like of other languages is called here, or "".
std::string hintForMember(std::string_view name, std::string_view member) {
  struct Theirs {
    const char *member, *before, *after;
  };
  constexpr Theirs kTheirs[] = {
      {"size", "size(", ")"},   {"width", "size(", ").x"}, {"height", "size(", ").y"}, {"mips", "mips(", ")"},
      {"levels", "mips(", ")"}, {"count", "count(", ")"},  {"length", "count(", ")"}};
  for (const Theirs& theirs : kTheirs)
    if (member == theirs.member) return fmt::format("write '{}{}{}'", theirs.before, name, theirs.after);
  if (isReservedWord(member)) return hintForPart(name);
  return base::hintForForeign(base::Foreign::value, fmt::format("{}.{}", name, member));
}

// ---- tokens: numbers, identifiers, operators ----

struct Token {
  enum class Kind : std::uint8_t { end, number, identifier, punctuation, bad };
  Kind kind = Kind::end;
  std::size_t begin = 0;
  std::string_view text;
  double number = 0;
};

std::size_t endOfNumber(std::string_view text, std::size_t at) {
  const auto digits = [&](std::size_t i) {
    while (i < text.size() && isDigit(text[i])) ++i;
    return i;
  };
  at = digits(at);
  if (at + 1 < text.size() && text[at] == '.' && isDigit(text[at + 1])) at = digits(at + 1);
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t exponent = at + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    if (exponent < text.size() && isDigit(text[exponent])) at = digits(exponent);
  }
  return at;
}

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
    end = endOfNumber(text, from);
    token.kind = Token::Kind::number;
    const auto result = std::from_chars(text.data() + from, text.data() + end, token.number);
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
constexpr std::size_t kMostItems =
    64;  // of a list or a call, counted for the message before they are too many
constexpr int kMaxParsedHeight =
    kMaxExprHeight - 1;  // leaves one level for the list that Expr::listOf puts around it
constexpr std::uint32_t kMaxParsedTerms = 1000;

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
    if (termsOver(children) > kMaxParsedTerms)
      return fail(blamed,
                  fmt::format("the expression has more than {} operators and operands", kMaxParsedTerms),
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
    const std::size_t begin = token_.begin;
    std::string rest;
    if (!parseDotted(rest, false)) return nullptr;
    if (at("["))
      return fail(token_, fmt::format("{}() takes a whole resource, without a selector", word.text));
    if (!accept(")")) return failUnexpected("')'");
    auto node = std::make_shared<ExprNode>();
    node->op = ExprOp::fact;
    node->fact = fact;
    node->dynamic = fact == Fact::age;
    node->key = static_cast<std::uint32_t>(begin - word.begin);
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
