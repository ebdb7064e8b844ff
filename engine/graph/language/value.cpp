// Declared in expr.h.
#include <fmt/format.h>

#include "engine/graph/language/expr.h"
#include "engine/graph/language/names.h"

namespace weft::graph {

std::string toText(const Value& value) {
  switch (value.type) {
    case Value::Type::none:
      return "none";
    case Value::Type::boolean:
      return value.v[0] != 0 ? "true" : "false";
    case Value::Type::number:
      return fmt::format("{}", value.v[0] == 0 ? 0.0 : value.v[0]);
    case Value::Type::symbol:
      return value.symbol;
    case Value::Type::list:
      break;
  }
  std::string out = "[";
  for (int i = 0; i < value.count; ++i)
    out += fmt::format("{}{}", i > 0 ? ", " : "", value.v[i] == 0 ? 0.0 : value.v[i]);
  return out + "]";
}

std::optional<double> parseNumber(std::string_view text) {
  return text::numberIn<double>(trimmed(text));
}

Value parseValue(std::string_view text) {
  text = trimmed(text);
  if (text == "true" || text == "false") return Value::boolean(text == "true");
  if (const auto number = parseNumber(text)) return Value::number(*number);
  if (text.size() >= 2 && text.front() == '[' && text.back() == ']') {
    Value list;
    list.type = Value::Type::list;
    std::string_view rest = text.substr(1, text.size() - 2);
    while (list.count < 4) {
      const std::size_t comma = rest.find(',');
      const auto number = parseNumber(rest.substr(0, comma));
      if (!number) break;
      list.v[list.count++] = *number;
      if (comma == std::string_view::npos) return list;
      rest = rest.substr(comma + 1);
    }
  }
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return Value::text(std::string(text));
}

}  // namespace weft::graph
