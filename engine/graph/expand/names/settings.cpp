#include "engine/graph/expand/names/settings.h"

#include <fmt/format.h>

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

}  // namespace weft::graph
