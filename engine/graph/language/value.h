// What an expression yields: a number, a boolean, a list of one to four numbers, or a symbol (a choice such as
// `billboard`, or a path). All numbers are double, and are converted where they are used.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace weft::graph {

struct Value {
  enum class Type : std::uint8_t { none, number, boolean, list, symbol };
  Type type = Type::none;
  std::uint8_t count = 0;     // components in use: 1 for number and boolean, 1..4 for a list
  std::array<double, 4> v{};  // booleans are 0 or 1
  std::string symbol{};

  static Value number(double x) { return {Type::number, 1, {x, 0, 0, 0}, {}}; }
  static Value boolean(bool b) { return {Type::boolean, 1, {b ? 1.0 : 0.0, 0, 0, 0}, {}}; }
  static Value text(std::string s) { return {Type::symbol, 0, {}, std::move(s)}; }

  bool isNumeric() const { return type == Type::number || type == Type::boolean; }
  bool truth() const { return isNumeric() && v[0] != 0; }
  friend bool operator==(const Value&, const Value&) = default;
};

// "1.5", "true", "[1, 2]", "billboard": canonical, shortest round-trip numbers.
std::string toText(const Value& value);

// A value as a person types it behind --set NAME=: a JSON scalar or a list of one to four numbers, else a word; quotes
// around a word may be left out.
Value parseValue(std::string_view text);
// A finite number, perhaps with blanks around it; else nothing.
std::optional<double> parseNumber(std::string_view text);

}  // namespace weft::graph
