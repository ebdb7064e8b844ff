// ASCII character classes, independent of the locale.
#pragma once

namespace weft::base {

constexpr bool isSpace(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}
constexpr bool isDigit(char c) {
  return c >= '0' && c <= '9';
}
constexpr bool isIdentStart(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
constexpr bool isIdentChar(char c) {
  return isIdentStart(c) || isDigit(c);
}

}  // namespace weft::base
