#include "engine/glsl/tokens.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <utility>

#include "engine/base/chars.h"

namespace weft::glsl {

namespace {

constexpr std::array<std::string_view, 23> kSigns{
    "<<=", ">>=", "##", "++", "--", "<<", ">>", "<=", ">=", "==", "!=", "&&",
    "||",  "^^",  "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "::"};

// A backslash before the end of a line, and the end of it: how many characters, or 0.
std::size_t continuationAt(std::string_view text, std::size_t at) {
  if (text[at] != '\\') return 0;
  const std::string_view rest = text.substr(at + 1, 2);
  return rest.starts_with('\n') ? 2 : rest == "\r\n" ? 3 : 0;
}

}  // namespace

std::vector<Token> splitTokens(std::string_view text) {
  std::vector<Token> tokens;
  std::uint32_t line = 1;
  std::size_t lineStart = 0;
  bool first = true;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '\n') {
      ++line;
      first = true;
      lineStart = ++i;
    } else if (const std::size_t skip = continuationAt(text, i); skip > 0) {
      ++line;
      lineStart = i += skip;
    } else if (std::isspace(static_cast<unsigned char>(text[i])) != 0) {
      ++i;
    } else if (text.substr(i, 2) == "//") {
      while (i < text.size() && text[i] != '\n') {
        const std::size_t goOn = continuationAt(text, i);
        line += goOn > 0 ? 1 : 0;
        i += std::max<std::size_t>(goOn, 1);
      }
    } else if (text.substr(i, 2) == "/*") {
      const std::size_t found = text.find("*/", i + 2);
      const std::size_t end = found == std::string_view::npos ? text.size() : found + 2;
      for (; i < end; ++i)
        if (text[i] == '\n') {
          ++line;
          lineStart = i + 1;
          first = true;
        }
    } else {
      Token token{.text = {}, .line = line, .column = static_cast<std::uint32_t>(i - lineStart + 1)};
      token.first = std::exchange(first, false);
      const bool number =
          base::isDigit(text[i]) || (text[i] == '.' && i + 1 < text.size() && base::isDigit(text[i + 1]));
      std::size_t end = i + 1;
      if (number) {
        token.kind = TokenKind::number;
        while (end < text.size() &&
               (base::isIdentChar(text[end]) || text[end] == '.' ||
                ((text[end] == '+' || text[end] == '-') && (text[end - 1] == 'e' || text[end - 1] == 'E') &&
                 !text.substr(i).starts_with("0x"))))
          ++end;
      } else if (base::isIdentStart(text[i])) {
        token.kind = TokenKind::word;
        while (end < text.size() && base::isIdentChar(text[end])) ++end;
      } else {
        for (const std::string_view sign : kSigns)
          if (text.substr(i).starts_with(sign)) {
            end = i + sign.size();
            break;
          }
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
  static int rankOf(std::string_view sign) {
    constexpr std::pair<std::string_view, int> kRanks[] = {
        {"||", 1}, {"&&", 2}, {"|", 3},  {"^", 4},  {"&", 5}, {"==", 6}, {"!=", 6}, {"<", 7},  {">", 7},
        {"<=", 7}, {">=", 7}, {"<<", 8}, {">>", 8}, {"+", 9}, {"-", 9},  {"*", 10}, {"/", 10}, {"%", 10}};
    for (const auto& [text, rank] : kRanks)
      if (text == sign) return rank;
    return 0;
  }

  static Value combine(std::string_view sign, std::int64_t a, std::int64_t b) {
    const auto ua = static_cast<std::uint64_t>(a), ub = static_cast<std::uint64_t>(b);
    if (sign == "||") return a != 0 || b != 0;
    if (sign == "&&") return a != 0 && b != 0;
    if (sign == "|") return a | b;
    if (sign == "^") return a ^ b;
    if (sign == "&") return a & b;
    if (sign == "==") return a == b;
    if (sign == "!=") return a != b;
    if (sign == "<") return a < b;
    if (sign == ">") return a > b;
    if (sign == "<=") return a <= b;
    if (sign == ">=") return a >= b;
    if (sign == "<<") return static_cast<std::int64_t>(ua << (ub & 63));
    if (sign == ">>") return a >> (ub & 63);
    if (sign == "+") return static_cast<std::int64_t>(ua + ub);
    if (sign == "-") return static_cast<std::int64_t>(ua - ub);
    if (sign == "*") return static_cast<std::int64_t>(ua * ub);
    if (b == 0 || b == -1) return std::nullopt;
    return sign == "/" ? a / b : a % b;
  }

  Value parse(int above) {
    Value left = unary();
    while (left && at_ < tokens_.size()) {
      const std::string_view sign = tokens_[at_].text;
      const int rank = rankOf(sign);
      if (rank <= above) break;
      ++at_;
      const Value right = parse(rank);
      if (!right) return std::nullopt;
      left = combine(sign, *left, *right);
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
    int base = 10;
    if (text.starts_with("0x") || text.starts_with("0X")) {
      text.remove_prefix(2);
      base = 16;
    } else if (text.size() > 1 && text[0] == '0') {
      base = 8;
    }
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
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

}  // namespace weft::glsl
