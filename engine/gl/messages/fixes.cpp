#include "engine/gl/messages/fixes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace weft::gl {

namespace {

// "vec4" to 4, "float" to 1, else 0.
int componentsOf(std::string_view type) {
  if (type == "float") return 1;
  return type.size() == 4 && type.starts_with("vec") && type[3] >= '2' && type[3] <= '4' ? type[3] - '0' : 0;
}

}  // namespace

std::string fixForAssignment(std::string_view message) {
  constexpr std::string_view kTo = " cannot be assigned to variable of type ", kFrom = " of type ";
  const std::size_t to = message.find(kTo), from = message.find(kFrom);
  if (to == std::string_view::npos || from == std::string_view::npos || from >= to) return {};
  const std::string_view given = message.substr(from + kFrom.size(), to - from - kFrom.size());
  const std::string_view wanted = message.substr(to + kTo.size());
  const int has = componentsOf(given), needs = componentsOf(wanted);
  if (has > needs && needs > 0)
    return fmt::format("write '.{}' behind the value, or declare a {}",
                       std::string_view("xyzw").substr(0, static_cast<std::size_t>(needs)), given);
  if (has == 1 && needs > 1) return fmt::format("write '{}(…)' around the value", wanted);
  return {};
}

bool isGiven(std::string_view name, std::span<const glsl::Define> defines) {
  std::string presence = "HAS_";
  for (const char c : name) presence += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return std::ranges::find(defines, presence, &glsl::Define::name) != defines.end();
}

}  // namespace weft::gl
