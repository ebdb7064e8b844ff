#include "engine/glsl/tokens.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <iterator>
#include <ranges>
#include <unordered_map>
#include <utility>

#include "engine/text/chars.h"

namespace weft::glsl {

namespace {

// Of the sign that a text begins with: "##", "<<=", "!=", …
std::size_t signSize(std::string_view text) {
  const char first = text[0], next = text.size() > 1 ? text[1] : '\0';
  const auto isOneOf = [&](std::string_view all) { return all.find(first) != std::string_view::npos; };
  if (first == next && isOneOf("#+-<>=&|^:")) return isOneOf("<>") && text.substr(2).starts_with('=') ? 3 : 2;
  return next == '=' && isOneOf("<>!+-*/%&|^") ? 2 : 1;
}

// A backslash before the end of a line, and the end of it: how many characters, or 0.
std::size_t continuationAt(std::string_view text, std::size_t at) {
  if (text[at] != '\\') return 0;
  const std::string_view rest = text.substr(at + 1, 2);
  return rest.starts_with('\n') ? 2 : rest == "\r\n" ? 3 : 0;
}

}  // namespace

std::string presenceDefineOf(std::string_view name) {
  std::string text = "HAS_" + std::string(name);
  for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  return text;
}

std::vector<Token> splitTokens(std::string_view text) {
  std::vector<Token> tokens;
  tokens.reserve(text.size() / 4);
  std::uint32_t line = 1;
  std::size_t lineStart = 0;
  bool first = true;
  std::size_t i = 0;
  const auto goTo = [&](std::size_t end) {
    for (; i < end; ++i)
      if (text[i] == '\n') {
        ++line;
        first = true;
        lineStart = i + 1;
      }
  };
  while (i < text.size()) {
    if (text[i] == '\n') {
      goTo(i + 1);
    } else if (const std::size_t skip = continuationAt(text, i); skip > 0) {
      ++line;
      lineStart = i += skip;
    } else if (text::isSpace(text[i]) || text[i] == '\f' || text[i] == '\v') {
      ++i;
    } else if (text[i] == '/' && i + 1 < text.size() && text[i + 1] == '/') {
      while (i < text.size() && text[i] != '\n') {
        const std::size_t goOn = continuationAt(text, i);
        line += goOn > 0 ? 1 : 0;
        i += std::max<std::size_t>(goOn, 1);
      }
    } else if (text[i] == '/' && i + 1 < text.size() && text[i + 1] == '*') {
      const std::size_t found = text.find("*/", i + 2);
      goTo(found == std::string_view::npos ? text.size() : found + 2);
    } else {
      Token token{.text = {}, .line = line, .column = static_cast<std::uint32_t>(i - lineStart + 1)};
      token.first = std::exchange(first, false);
      const bool number =
          text::isDigit(text[i]) || (text[i] == '.' && i + 1 < text.size() && text::isDigit(text[i + 1]));
      std::size_t end = i + 1;
      if (number) {
        token.kind = TokenKind::number;
        while (end < text.size() &&
               (text::isIdentChar(text[end]) || text[end] == '.' ||
                ((text[end] == '+' || text[end] == '-') && (text[end - 1] == 'e' || text[end - 1] == 'E') &&
                 !text.substr(i).starts_with("0x"))))
          ++end;
      } else if (text::isIdentStart(text[i])) {
        token.kind = TokenKind::word;
        while (end < text.size() && text::isIdentChar(text[end])) ++end;
      } else {
        end = i + signSize(text.substr(i));
      }
      token.text = text.substr(i, end - i);
      tokens.push_back(token);
      i = end;
    }
  }
  return tokens;
}

namespace {

using Value = std::optional<std::int64_t>;

// Of whole numbers, which wrap around. The higher rank binds tighter.
struct Operator {
  std::string_view sign;
  int rank;
  std::int64_t (*apply)(std::int64_t, std::int64_t);
};
using Bits = std::uint64_t;
constexpr Operator kOperators[] = {
    {"||", 1, [](auto a, auto b) { return std::int64_t{a != 0 || b != 0}; }},
    {"&&", 2, [](auto a, auto b) { return std::int64_t{a != 0 && b != 0}; }},
    {"|", 3, [](auto a, auto b) { return a | b; }},
    {"^", 4, [](auto a, auto b) { return a ^ b; }},
    {"&", 5, [](auto a, auto b) { return a & b; }},
    {"==", 6, [](auto a, auto b) { return std::int64_t{a == b}; }},
    {"!=", 6, [](auto a, auto b) { return std::int64_t{a != b}; }},
    {"<", 7, [](auto a, auto b) { return std::int64_t{a < b}; }},
    {">", 7, [](auto a, auto b) { return std::int64_t{a > b}; }},
    {"<=", 7, [](auto a, auto b) { return std::int64_t{a <= b}; }},
    {">=", 7, [](auto a, auto b) { return std::int64_t{a >= b}; }},
    {"<<", 8, [](auto a, auto b) { return static_cast<std::int64_t>(Bits(a) << (Bits(b) & 63)); }},
    {">>", 8, [](auto a, auto b) { return a >> (Bits(b) & 63); }},
    {"+", 9, [](auto a, auto b) { return static_cast<std::int64_t>(Bits(a) + Bits(b)); }},
    {"-", 9, [](auto a, auto b) { return static_cast<std::int64_t>(Bits(a) - Bits(b)); }},
    {"*", 10, [](auto a, auto b) { return static_cast<std::int64_t>(Bits(a) * Bits(b)); }},
    {"/", 10, [](auto a, auto b) { return a / b; }},
    {"%", 10, [](auto a, auto b) { return a % b; }}};

class Evaluator {
 public:
  Evaluator(std::span<const Token> tokens, const std::function<Value(std::string_view)>& valueOf,
            std::uint32_t deepest)
      : tokens_(tokens), valueOf_(valueOf), deepest_(deepest) {}

  Value run() {
    const Value value = parse(0);
    return at_ == tokens_.size() ? value : std::nullopt;
  }

 private:
  Value parse(int above) {
    Value left = unary();
    while (left && at_ < tokens_.size()) {
      const auto infix = std::ranges::find(kOperators, tokens_[at_].text, &Operator::sign);
      if (infix == std::end(kOperators) || infix->rank <= above) break;
      ++at_;
      const Value right = parse(infix->rank);
      const bool divides = infix->sign == "/" || infix->sign == "%";
      if (!right || (divides && (*right == 0 || *right == -1))) return std::nullopt;
      left = infix->apply(*left, *right);
    }
    return left;
  }

  Value unary() {
    if (at_ == tokens_.size() || depth_ == deepest_) return std::nullopt;
    ++depth_;
    const Value value = unaryInside();
    --depth_;
    return value;
  }

  Value unaryInside() {
    const Token& token = tokens_[at_++];
    if (token.kind == TokenKind::number) return numberOf(token.text);
    if (token.is("-") || token.is("+") || token.is("!") || token.is("~")) {
      const Value value = unary();
      if (!value || token.is("+")) return value;
      return token.is("-")   ? static_cast<std::int64_t>(-static_cast<std::uint64_t>(*value))
             : token.is("!") ? static_cast<std::int64_t>(*value == 0)
                             : ~*value;
    }
    // int(…) and uint(…) are brackets here.
    const bool conversion =
        (token.is("int") || token.is("uint")) && at_ < tokens_.size() && tokens_[at_].is("(");
    if (token.kind == TokenKind::word && !conversion) return valueOf_(token.text);
    if (conversion) ++at_;
    if (!conversion && !token.is("(")) return std::nullopt;
    const Value value = parse(0);
    if (at_ == tokens_.size() || !tokens_[at_].is(")")) return std::nullopt;
    ++at_;
    return value;
  }

  static Value numberOf(std::string_view text) {
    while (!text.empty() && (text.back() == 'u' || text.back() == 'U')) text.remove_suffix(1);
    const std::string digits(text);
    char* end = nullptr;
    errno = 0;
    const std::uint64_t value = std::strtoull(digits.c_str(), &end, 0);
    if (digits.empty() || *end != '\0' || errno != 0) return std::nullopt;
    return static_cast<std::int64_t>(value);
  }

  std::span<const Token> tokens_;
  const std::function<Value(std::string_view)>& valueOf_;
  const std::uint32_t deepest_;
  std::size_t at_ = 0;
  std::uint32_t depth_ = 0;
};

}  // namespace

std::optional<std::int64_t> evaluateTokens(std::span<const Token> tokens,
                                           const std::function<Value(std::string_view)>& valueOf,
                                           std::uint32_t deepest) {
  return Evaluator(tokens, valueOf, deepest).run();
}

namespace {

using Tokens = std::vector<Token>;

struct Macro {
  bool function = false;
  std::vector<std::string_view> parameters;
  Tokens body;
  int open = 0;  // being expanded: its name stands for itself
};

// What is left to expand, the next last: a token, or the end of what a macro stands for.
struct Rest {
  Token token;
  Macro* ended = nullptr;
};

class Expander {
 public:
  Expander(std::span<const Define> defines, std::uint32_t deepest, bool all) : deepest_(deepest), all_(all) {
    add("__VERSION__", "450");
    add("__LINE__", "1");
    add("__FILE__", "0");
    add("GL_core_profile", "1");
    for (const Define& define : defines) add(define.name, define.value);
  }

  TokenList run(std::string_view text) {
    const Tokens all = splitTokens(text);
    std::size_t begin = 0;  // of tokens between two directives
    for (std::size_t i = 0; i < all.size() && spend(0); ++i) {
      if (!all[i].first || !all[i].is("#")) continue;
      std::size_t end = i + 1;
      while (end < all.size() && !all[end].first) ++end;
      if (taken()) expandText(std::span(all).subspan(begin, i - begin));
      obey(std::span(all).subspan(i + 1, end - i - 1));
      begin = end;
      i = end - 1;
    }
    if (taken()) expandText(std::span(all).subspan(begin));
    return std::move(out_);
  }

 private:
  struct Branch {
    bool outer = true;    // what stands around is taken
    bool now = true;      // this branch is
    bool before = false;  // a branch before it was, for certain
  };

  void add(const std::string& name, const std::string& value) {
    const std::string_view kept = keep(name);
    macros_[kept] = {.body = splitTokens(keep(value))};
  }

  std::string_view keep(std::string text) { return out_.pasted.emplace_back(std::move(text)); }

  bool taken() const { return branches_.empty() || (branches_.back().outer && branches_.back().now); }

  void obey(std::span<const Token> line) {
    if (line.empty()) return;
    const std::string_view name = line[0].text;
    const std::span<const Token> rest = line.subspan(1);
    if (all_ && name != "define" && name != "undef") return;
    if (name == "if" || name == "ifdef" || name == "ifndef") {
      Branch branch{.outer = taken()};
      if (branch.outer) decide(branch, name == "if" ? valueOf(rest) : definedOf(rest, name == "ifdef"));
      branches_.push_back(branch);
    } else if (name == "elif" && !branches_.empty()) {
      Branch& branch = branches_.back();
      branch.now = false;
      if (branch.outer && !branch.before) decide(branch, valueOf(rest));
    } else if (name == "else" && !branches_.empty()) {
      branches_.back().now = !std::exchange(branches_.back().before, true);
    } else if (name == "endif" && !branches_.empty()) {
      branches_.pop_back();
    } else if (name == "define" && taken() && !rest.empty()) {
      define(rest);
    } else if (name == "undef" && taken() && !rest.empty()) {
      macros_.erase(rest[0].text);
    }
  }

  // Nothing: the driver knows. The branch is taken, and so may be the others.
  static void decide(Branch& branch, std::optional<std::int64_t> value) {
    branch.now = value.value_or(1) != 0;
    branch.before = value.value_or(0) != 0;
  }

  static bool isDrivers(std::string_view name) { return name.starts_with("GL_"); }

  std::optional<std::int64_t> definedOf(std::span<const Token> rest, bool wanted) {
    if (rest.empty()) return 0;
    const bool known = macros_.contains(rest[0].text);
    if (!known && isDrivers(rest[0].text)) return std::nullopt;
    return known == wanted ? 1 : 0;
  }

  std::optional<std::int64_t> valueOf(std::span<const Token> rest) {
    Tokens line;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      if (!rest[i].is("defined") || i + 1 == rest.size()) {
        line.push_back(rest[i]);
        continue;
      }
      const bool brackets = rest[i + 1].is("(") && i + 3 < rest.size();
      const Token& name = rest[i + (brackets ? 2 : 1)];
      const auto value = definedOf(std::span(&name, 1), true);
      Token number = name;
      number.kind = value ? TokenKind::number : TokenKind::word;
      number.text = !value ? "GL_" : *value != 0 ? "1" : "0";
      line.push_back(number);
      i += brackets ? 3 : 1;
    }
    Tokens expanded;
    expand(line, expanded, 0);
    out_.uncertain |= expanded.size() > deepest_;
    const auto known = [](std::string_view name) -> std::optional<std::int64_t> {
      if (isDrivers(name)) return std::nullopt;
      return 0;
    };
    return evaluateTokens(expanded, known, deepest_);
  }

  void define(std::span<const Token> rest) {
    Macro macro;
    std::size_t body = 1;
    const Token& name = rest[0];
    const bool adjacent = rest.size() > 1 && rest[1].is("(") && rest[1].line == name.line &&
                          rest[1].column == name.column + name.text.size();
    if (adjacent) {
      macro.function = true;
      for (body = 2; body < rest.size() && !rest[body].is(")"); ++body)
        if (!rest[body].is(",")) macro.parameters.push_back(rest[body].text);
      ++body;
    }
    if (body < rest.size()) macro.body.assign(rest.begin() + static_cast<std::ptrdiff_t>(body), rest.end());
    macros_[name.text] = std::move(macro);
  }

  void expandText(std::span<const Token> text) { expand(text, out_.tokens, 0); }

  // Tokens that macros make on the way count as well. False when there were too many.
  bool spend(std::uint64_t count) {
    constexpr std::uint64_t kMost = 1'000'000;
    spent_ += count;
    out_.uncertain |= spent_ > kMost;
    return spent_ <= kMost;
  }

  // Appends what `text` stands for to `to`. `depth`: of arguments of macros in arguments of macros.
  void expand(std::span<const Token> text, Tokens& to, std::uint32_t depth) {
    std::vector<Rest> rest;
    for (const Token& token : text | std::views::reverse) rest.push_back({token});
    while (std::optional<Token> token = next(rest)) {
      if (!spend(1)) continue;  // but macros end
      const auto found =
          token->kind == TokenKind::word && !token->inert ? macros_.find(token->text) : macros_.end();
      Macro* const macro = found == macros_.end() ? nullptr : &found->second;
      token->inert |= macro && macro->open > 0;
      if (!macro || token->inert || (macro->function && !isCalled(rest, depth)))
        to.push_back(*token);
      else if (macro->function)
        call(rest, *macro, *token, depth);
      else
        push(rest, *macro, macro->body, *token);
    }
  }

  static void leaveEnded(std::vector<Rest>& rest) {
    for (; !rest.empty() && rest.back().ended; rest.pop_back()) --rest.back().ended->open;
  }
  static std::optional<Token> next(std::vector<Rest>& rest) {
    leaveEnded(rest);
    if (rest.empty()) return std::nullopt;
    const Token token = rest.back().token;
    rest.pop_back();
    return token;
  }
  // Whether a bracket follows; else the name of the macro stands for itself.
  bool isCalled(std::vector<Rest>& rest, std::uint32_t depth) {
    leaveEnded(rest);
    out_.uncertain |= rest.empty() && depth == 0;
    return !rest.empty() && rest.back().token.is("(");
  }

  void push(std::vector<Rest>& rest, Macro& macro, Tokens body, const Token& use) {
    paste(body);
    if (!spend(body.size())) return;
    ++macro.open;
    rest.push_back({.token = {}, .ended = &macro});
    for (Token& token : body | std::views::reverse) {
      token.line = use.line;
      token.column = use.column;
      rest.push_back({token});
    }
  }

  void call(std::vector<Rest>& rest, Macro& macro, const Token& use, std::uint32_t depth) {
    std::vector<Tokens> arguments(1);
    for (int brackets = 0;;) {
      const std::optional<Token> token = next(rest);
      out_.uncertain |= !token;  // a directive stands between its brackets
      if (!token || !spend(1)) return;
      if (token->is("(") && brackets++ == 0) continue;
      if (token->is(")") && --brackets == 0) break;
      if (token->is(",") && brackets == 1)
        arguments.emplace_back();
      else
        arguments.back().push_back(*token);
    }
    out_.uncertain |= depth + 1 >= deepest_;
    if (depth + 1 < deepest_) push(rest, macro, substitute(macro, arguments, depth), use);
  }

  Tokens substitute(const Macro& macro, const std::vector<Tokens>& arguments, std::uint32_t depth) {
    std::vector<std::optional<Tokens>> expanded(arguments.size());
    Tokens made;
    for (std::size_t i = 0; i < macro.body.size() && spend(0); ++i) {
      const Token& token = macro.body[i];
      const auto found = token.kind == TokenKind::word
                             ? std::find(macro.parameters.begin(), macro.parameters.end(), token.text)
                             : macro.parameters.end();
      const auto index = static_cast<std::size_t>(found - macro.parameters.begin());
      if (found == macro.parameters.end() || index >= arguments.size()) {
        made.push_back(token);
        continue;
      }
      const bool pasted =
          (i > 0 && macro.body[i - 1].is("##")) || (i + 1 < macro.body.size() && macro.body[i + 1].is("##"));
      if (!pasted && !expanded[index]) expand(arguments[index], expanded[index].emplace(), depth + 1);
      const Tokens& from = pasted ? arguments[index] : *expanded[index];
      if (!spend(from.size())) break;
      made.insert(made.end(), from.begin(), from.end());
    }
    return made;
  }

  void paste(Tokens& body) {
    if (std::none_of(body.begin(), body.end(), [](const Token& t) { return t.is("##"); })) return;
    Tokens made;
    for (std::size_t i = 0; i < body.size(); ++i) {
      if (!body[i].is("##") || made.empty() || i + 1 == body.size()) {
        made.push_back(body[i]);
        continue;
      }
      made.back().text = keep(std::string(made.back().text).append(body[++i].text));
      made.back().inert = false;
    }
    body = std::move(made);
  }

  const std::uint32_t deepest_;
  const bool all_;  // branches
  std::uint64_t spent_ = 0;
  std::unordered_map<std::string_view, Macro> macros_;
  std::vector<Branch> branches_;
  TokenList out_;
};

}  // namespace

TokenList expandTokens(std::string_view text, std::span<const Define> defines, std::uint32_t deepest,
                       Branches branches) {
  return Expander(defines, deepest, branches == Branches::all).run(text);
}

Conditions conditionsOf(std::string_view text) {
  Conditions found;
  const std::vector<Token> all = splitTokens(text);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i].first || !all[i].is("#") || i + 1 == all.size()) {
      if (all[i].kind == TokenKind::word) found.used.insert(all[i].text);
      continue;
    }
    const Token& directive = all[++i];
    const bool tests = directive.is("ifdef") || directive.is("ifndef");
    const bool compares = directive.is("if") || directive.is("elif");
    if (directive.is("define") && i + 1 < all.size()) found.made.insert(all[i + 1].text);
    for (; i + 1 < all.size() && !all[i + 1].first; ++i) {
      const Token& word = all[i + 1];
      if (word.kind != TokenKind::word || word.is("defined")) continue;
      const bool tested = tests || all[i].is("defined") || (all[i].is("(") && all[i - 1].is("defined"));
      if (tested || compares) (tested ? found.tested : found.valued).push_back(word);
      if (!tested) found.used.insert(word.text);
    }
  }
  return found;
}

}  // namespace weft::glsl
