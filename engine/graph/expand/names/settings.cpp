#include "engine/graph/expand/names/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace weft::graph {

Setting::Setting(std::string setName, std::string setText)
    : name(std::move(setName)), value(parseValue(setText)), text(std::move(setText)) {}

Setting::Setting(std::string setName, Value setValue, Origin setOrigin)
    : name(std::move(setName)), value(std::move(setValue)), origin(setOrigin) {}

std::string sourceOf(const Setting& setting) {
  if (setting.origin == Origin::command_line)
    return fmt::format("{} {}={}", setting.option, setting.name, setting.text);
  return fmt::format("the value {} set here for {}", toText(setting.value), setting.name);
}

std::string sourceOf(const Disable& disable) {
  return disable.origin == Origin::command_line ? disable.option + " " + disable.name
                                                : fmt::format("switching off {} here", disable.name);
}

int componentsOf(ParameterDesc::Type type) {
  using Type = ParameterDesc::Type;
  return type == Type::vec2 ? 2 : type == Type::vec3 ? 3 : type == Type::vec4 ? 4 : 0;
}

bool fitsType(const ParameterDesc& desc, const Value& value) {
  const bool number = value.type == Value::Type::number, word = value.type == Value::Type::symbol;
  switch (desc.type) {
    case ParameterDesc::Type::boolean:
      return value.type == Value::Type::boolean;
    case ParameterDesc::Type::integer:
      return number && value.v[0] == std::floor(value.v[0]);
    case ParameterDesc::Type::number:
      return number;
    case ParameterDesc::Type::choice:
      return word && std::ranges::find(desc.choices, value.symbol) != desc.choices.end();
    case ParameterDesc::Type::file:
      return word;
    default:
      return value.type == Value::Type::list && value.count == componentsOf(desc.type);
  }
}

bool fitsRange(const ParameterDesc& desc, const Value& value) {
  if (value.type == Value::Type::boolean) return true;
  return std::all_of(value.v.begin(), value.v.begin() + value.count, [&](double x) {
    return std::isfinite(x) && (!desc.min || x >= *desc.min) && (!desc.max || x <= *desc.max);
  });
}

}  // namespace weft::graph
