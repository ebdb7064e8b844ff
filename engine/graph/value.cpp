#include "engine/graph/value.h"

#include <fmt/format.h>

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

}  // namespace weft::graph
