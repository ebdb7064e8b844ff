#include "engine/graph/language/expr_token.h"

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

}  // namespace weft::graph
