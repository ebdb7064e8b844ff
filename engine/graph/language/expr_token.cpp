#include "engine/graph/language/expr_token.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "engine/graph/language/names.h"

namespace weft::graph {

namespace {

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

}  // namespace

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

std::string hintForSize(std::string_view text) {
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
  if (rest[0] != 'x' && rest[0] != 'X') return {};
  const auto other = std::from_chars(number.ptr + 1, end, second);
  return other.ec == std::errc() && other.ptr == end ? fmt::format("write [{}, {}]", first, second) : "";
}

}  // namespace weft::graph
